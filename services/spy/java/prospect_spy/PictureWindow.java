package prospect_spy;

import java.awt.Color;
import java.awt.Dimension;
import java.awt.Graphics;
import javax.swing.JDesktopPane;
import javax.swing.JInternalFrame;
import javax.swing.JPanel;
import javax.swing.Timer;
import javax.swing.event.InternalFrameAdapter;
import javax.swing.event.InternalFrameEvent;
import lcm.spy.ChannelData;

/**
 * A window with a channel's latest picture, enlarged by whole pixels so that one sees what the networks see. It looks ten times a
 * second at the message that lcm-spy decoded last, so it needs no subscription, and no bus, of its own.
 */
final class PictureWindow extends JPanel {
  private static final long serialVersionUID = 1;
  private static final int PERIOD_MS = 100;
  private static final int CAPTION_HEIGHT = 20;

  private final transient ChannelData channel;
  private transient Object shown;
  private transient Picture picture;

  private PictureWindow(ChannelData channel) {
    this.channel = channel;
    setPreferredSize(new Dimension(320, 320 + CAPTION_HEIGHT));
    setBackground(Color.BLACK);
  }

  static void open(JDesktopPane desktop, ChannelData channel) {
    PictureWindow window = new PictureWindow(channel);
    Timer timer = new Timer(PERIOD_MS, event -> window.refresh());
    JInternalFrame frame = new JInternalFrame(channel.name, true, true, true, true);
    frame.addInternalFrameListener(
        new InternalFrameAdapter() {
          @Override
          public void internalFrameClosed(InternalFrameEvent event) {
            timer.stop();
          }
        });
    frame.add(window);
    frame.pack();
    desktop.add(frame);
    frame.setVisible(true);
    frame.toFront();
    timer.start();
  }

  private void refresh() {
    Object latest = channel.last;
    if (latest == shown) return;
    shown = latest;
    picture = Picture.of(latest);
    repaint();
  }

  @Override
  protected void paintComponent(Graphics graphics) {
    super.paintComponent(graphics);
    graphics.setColor(Color.WHITE);
    if (picture == null) {
      graphics.drawString("no picture in the latest message", 8, 14);
      return;
    }
    graphics.drawString(picture.caption, 8, 14);
    drawEnlarged(graphics);
  }

  private void drawEnlarged(Graphics graphics) {
    int width = picture.image.getWidth();
    int height = picture.image.getHeight();
    int room = getHeight() - CAPTION_HEIGHT;
    double fit = Math.min((double) getWidth() / width, (double) room / height);
    double scale = fit >= 1 ? Math.floor(fit) : fit;
    int shownWidth = (int) (width * scale);
    int shownHeight = (int) (height * scale);
    int left = (getWidth() - shownWidth) / 2;
    int top = CAPTION_HEIGHT + (room - shownHeight) / 2;
    graphics.drawImage(picture.image, left, top, shownWidth, shownHeight, null);
  }
}
