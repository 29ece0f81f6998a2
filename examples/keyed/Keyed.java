import static java.nio.file.attribute.PosixFilePermission.OWNER_READ;
import static java.nio.file.attribute.PosixFilePermission.OWNER_WRITE;

import java.io.IOException;
import java.nio.ByteBuffer;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.security.GeneralSecurityException;
import java.security.MessageDigest;
import java.security.SecureRandom;
import java.util.Arrays;
import java.util.HashMap;
import java.util.HexFormat;
import java.util.Map;
import java.util.Set;
import java.util.TreeSet;
import javax.crypto.Mac;
import javax.crypto.spec.SecretKeySpec;

/**
 * A deployment's key for a robot in Java: the JDK is all it takes.
 *
 * <pre>
 *   Keyed keyed = new Keyed(Path.of("key"));
 *   lcm.publish(channel, tagged, 0, tagged.length);   // tagged = keyed.sign(channel, bytes of a message)
 *   byte[] message = keyed.verify(channel, bytes);    // in a handler; null: refuse it
 * </pre>
 *
 * What a tag is: docs/security.md. Run as a program, it signs or verifies standard input: java Keyed.java
 * sign|verify KEYFILE CHANNEL. One thread.
 */
public class Keyed {
  private static final int TAG = 24, MAC = 12;
  private static final long WINDOW = 4096; // how far messages may overtake one another on the way

  private static final class Heard {
    long first, newest;
    final TreeSet<Long> taken = new TreeSet<>();
  }

  private final Mac mac = Mac.getInstance("HmacSHA256");
  private final int sender = new SecureRandom().nextInt();
  private final Map<Integer, Heard> heard = new HashMap<>();
  private long sequence = 0;

  public Keyed(Path keyFile) throws IOException, GeneralSecurityException {
    if (!Set.of(OWNER_READ, OWNER_WRITE).containsAll(Files.getPosixFilePermissions(keyFile)))
      throw new IOException(keyFile + " is open to other users: chmod 600");
    byte[] key = HexFormat.of().parseHex(Files.readString(keyFile).trim());
    mac.init(new SecretKeySpec(key, "HmacSHA256"));
  }

  private byte[] macOf(String channel, byte[] bytes, int length) {
    mac.update(channel.getBytes(StandardCharsets.US_ASCII));
    mac.update((byte) 0);
    mac.update(bytes, 0, length);
    return Arrays.copyOf(mac.doFinal(), MAC);
  }

  public byte[] sign(String channel, byte[] message) {
    byte[] tagged = Arrays.copyOf(message, message.length + TAG);
    ByteBuffer.wrap(tagged, message.length, TAG).putInt(sender).putLong(++sequence);
    int covered = tagged.length - MAC;
    System.arraycopy(macOf(channel, tagged, covered), 0, tagged, covered, MAC);
    return tagged;
  }

  /** The message without its tag, or null for one that must not be believed. */
  public byte[] verify(String channel, byte[] tagged) {
    if (tagged.length < TAG) return null;
    int covered = tagged.length - MAC;
    byte[] said = Arrays.copyOfRange(tagged, covered, tagged.length);
    if (!MessageDigest.isEqual(said, macOf(channel, tagged, covered))) return null;
    ByteBuffer tag = ByteBuffer.wrap(tagged, tagged.length - TAG, TAG);
    int from = tag.getInt();
    return isNew(from, tag.getLong()) ? Arrays.copyOf(tagged, tagged.length - TAG) : null;
  }

  private boolean isNew(int from, long number) {
    Heard known = heard.computeIfAbsent(from, any -> {
      Heard fresh = new Heard();
      fresh.first = fresh.newest = number - 1;
      return fresh;
    });
    if (number <= Math.max(known.first, known.newest - WINDOW) || !known.taken.add(number)) return false;
    known.newest = Math.max(known.newest, number);
    known.taken.headSet(known.newest - WINDOW, true).clear();
    return true;
  }

  public static void main(String[] arguments) throws Exception {
    Keyed keyed = new Keyed(Path.of(arguments[1]));
    byte[] given = System.in.readAllBytes();
    boolean sign = arguments[0].equals("sign");
    byte[] result = sign ? keyed.sign(arguments[2], given) : keyed.verify(arguments[2], given);
    if (result == null) {
      System.err.println("not authentic");
      System.exit(1);
    }
    System.out.write(result);
    System.out.flush();
  }
}
