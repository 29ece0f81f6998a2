package prospect_spy;

import java.util.Enumeration;
import java.util.jar.JarEntry;
import java.util.jar.JarFile;

/**
 * Lists the message types in a jar with their fingerprints, found as lcm-spy finds them: every class with a static LCM_FINGERPRINT. A test
 * compares the list with the C++ types; a person sees whether a jar fits the programs.
 */
public final class TypeList {
  private TypeList() {}

  public static void main(String[] arguments) throws Exception {
    if (arguments.length != 1) {
      System.err.println("usage: java -cp lcm.jar:FILE.jar prospect_spy.TypeList FILE.jar");
      System.exit(2);
    }
    try (JarFile jar = new JarFile(arguments[0])) {
      for (Enumeration<JarEntry> entries = jar.entries(); entries.hasMoreElements(); ) {
        list(entries.nextElement().getName());
      }
    }
  }

  private static void list(String entry) throws Exception {
    if (!entry.startsWith("prospect/") || !entry.endsWith(".class")) return;
    Class<?> type = Class.forName(entry.substring(0, entry.length() - 6).replace('/', '.'));
    long fingerprint = type.getField("LCM_FINGERPRINT").getLong(null);
    System.out.println(type.getSimpleName() + " " + fingerprint);
  }
}
