package prospect_spy;

import java.awt.image.BufferedImage;

/** A picture taken out of a message, with a line on what it is. */
final class Picture {
  final BufferedImage image;
  final String caption;

  private Picture(BufferedImage image, String caption) {
    this.image = image;
    this.caption = caption;
  }

  /** The picture in a message, or null where there is none (another type, no picture wanted, wrong size). */
  static Picture of(Object message) {
    if (message instanceof prospect.observation_t) {
      prospect.observation_t m = (prospect.observation_t) message;
      return of(m.width, m.height, m.data, "episode " + m.episode_id + ", frame " + m.frame);
    }
    if (message instanceof prospect.search_image_t) {
      prospect.search_image_t m = (prospect.search_image_t) message;
      return of(m.width, m.height, m.data, "image " + m.image_id);
    }
    if (message instanceof prospect.predict_reply_t) {
      prospect.predict_reply_t m = (prospect.predict_reply_t) message;
      return of(m.width, m.height, m.data, "predicted, path of " + m.path.num_actions + " actions");
    }
    return null;
  }

  private static Picture of(int width, int height, byte[] rgb, String caption) {
    if (width < 1 || height < 1 || rgb == null || rgb.length != (long) width * height * 3) return null;
    BufferedImage image = new BufferedImage(width, height, BufferedImage.TYPE_INT_RGB);
    for (int i = 0; i < width * height; ++i) {
      int pixel = (rgb[3 * i] & 0xff) << 16 | (rgb[3 * i + 1] & 0xff) << 8 | (rgb[3 * i + 2] & 0xff);
      image.setRGB(i % width, i / width, pixel);
    }
    return new Picture(image, caption + ", " + width + " x " + height);
  }
}
