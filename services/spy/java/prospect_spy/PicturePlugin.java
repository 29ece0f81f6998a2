package prospect_spy;

import java.awt.event.ActionEvent;
import javax.swing.AbstractAction;
import javax.swing.Action;
import javax.swing.JDesktopPane;
import lcm.spy.ChannelData;
import lcm.spy.SpyPlugin;

/**
 * Shows the pictures on OBSERVATION, SEARCH_IMAGE and PREDICT_REPLY inside lcm-spy. lcm-spy finds this class by itself on the class
 * path; a right click on such a channel then offers "Show picture".
 */
public class PicturePlugin implements SpyPlugin {
  @Override
  public boolean canHandle(long fingerprint) {
    return fingerprint == prospect.observation_t.LCM_FINGERPRINT
        || fingerprint == prospect.search_image_t.LCM_FINGERPRINT
        || fingerprint == prospect.predict_reply_t.LCM_FINGERPRINT;
  }

  @Override
  public Action getAction(JDesktopPane desktop, ChannelData channel) {
    return new AbstractAction("Show picture") {
      private static final long serialVersionUID = 1;

      @Override
      public void actionPerformed(ActionEvent event) {
        PictureWindow.open(desktop, channel);
      }
    };
  }
}
