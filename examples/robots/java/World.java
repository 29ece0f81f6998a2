import java.util.ArrayList;
import java.util.List;

/**
 * The sorting table: two grippers, four coloured blocks, three bins; two of the blocks are to be put into bins. What decides is in
 * the picture alone. A gripper reaches three of the four places (the left one not the rightmost, and the other way round), takes no
 * block that another stands on, and puts one block into a bin that has no lid; the left one fills the left and the middle bin, the
 * right one the middle and the right. So a block taken by the wrong gripper has nowhere to go. The same rules, scenes and pictures
 * in Python and C++: ../python/world.py, ../cpp/world.h.
 */
final class World {
  /** A row of the action table: gripper 0 (left) or 1 takes a block, or puts what it holds into a bin. */
  record Action(int side, boolean take, int thing) {
    String kind() {
      return (side == 0 ? "left" : "right") + (take ? "_take" : "_put");
    }

    String object() {
      return take ? COLOURS[thing] : BINS[thing];
    }

    int[] successors() {
      return take ? PUTS[side] : TAKES;
    }
  }

  static final String[] COLOURS = {"red", "green", "blue", "yellow"}, BINS = {"left_bin", "middle_bin", "right_bin"};
  static final List<Action> ACTIONS = new ArrayList<>();
  static final int[] TAKES = {0, 1, 2, 3, 4, 5, 6, 7};
  static final int[][] PUTS = {{8, 9}, {10, 11}};
  static final String[][] CAUSES = {{"reach", "it stands out of this gripper's reach"}, {"blocked", "another block stands on it"},
      {"gone", "it was put away before"}, {"lid", "the lid is on this bin"}, {"full", "this bin is full"}};
  static final int ENOUGH = 2, PLAN_LENGTH = 4; // blocks in bins, each taken and put
  static final int SIDE = 64; // pixels
  static final int TICKS = 10; // of an action; the gripper is there after half of them

  static {
    for (int action : TAKES) ACTIONS.add(new Action(action / 4, true, action % 4));
    for (int bin : new int[] {0, 1}) ACTIONS.add(new Action(0, false, bin));
    for (int bin : new int[] {1, 2}) ACTIONS.add(new Action(1, false, bin));
  }

  private static final int NOTHING = -1;
  private static final int[][] PAINT = {{230, 40, 40}, {40, 200, 60}, {50, 90, 240}, {240, 220, 40}};
  private static final int[] FLOOR = {30, 30, 30}, TABLE = {90, 90, 90}, ALARM = {255, 140, 0}, GRIPPER = {255, 255, 255},
      LID = {235, 235, 235}, WALL = {0, 190, 190};
  private static final int[][] HOME = {{8, 34}, {40, 34}};

  /** SplitMix64: the same numbers in every language. */
  private static final class Dice {
    private long state;

    Dice(long seed) {
      state = seed;
    }

    int below(int bound) {
      long z = state += 0x9E3779B97F4A7C15L;
      z = (z ^ (z >>> 30)) * 0xBF58476D1CE4E5B9L;
      z = (z ^ (z >>> 27)) * 0x94D049BB133111EBL;
      return (int) (((z ^ (z >>> 31)) >>> 33) % bound);
    }
  }

  private final List<List<Integer>> places = new ArrayList<>(); // blocks of each place, from below
  private final boolean[] lids = new boolean[3];
  private final int[] bins = {NOTHING, NOTHING, NOTHING}, hands = {NOTHING, NOTHING};
  private Action action; // under way, or where it failed
  private int[] goal;
  private int ticks, putAway;
  private String cause = "";

  /** A scene: four blocks on three of the places, one of them on another; no bin, one or two with a lid. */
  World(long seed) {
    Dice dice = new Dice(seed);
    int[] order = {0, 1, 2, 3};
    for (int i = 3; i > 0; --i) {
      int j = dice.below(i + 1), swapped = order[i];
      order[i] = order[j];
      order[j] = swapped;
    }
    int first = dice.below(2), tall = dice.below(3), closed = dice.below(5), odd = dice.below(3);
    for (int i = 0; i < 4; ++i) places.add(new ArrayList<>());
    for (int i = 0; i < 3; ++i) places.get(first + i).add(order[i]);
    places.get(first + tall).add(order[3]);
    // In one scene of five two bins are closed, and two blocks have no room; in two of five one is.
    for (int i = 0; i < 3; ++i) lids[i] = closed == 0 ? i != odd : closed < 3 && i == odd;
  }

  /** Why it cannot be begun at all; empty: it can. */
  String refusal(int index) {
    if (index < 0 || index >= ACTIONS.size()) return "there is no such action";
    if (!cause.isEmpty() || done()) return "the episode is over";
    Action wanted = ACTIONS.get(index);
    if (wanted.take && (hands[0] != NOTHING || hands[1] != NOTHING)) return "a gripper holds a block";
    if (!wanted.take && hands[wanted.side] == NOTHING) return "this gripper holds no block";
    return "";
  }

  void begin(int index) {
    action = ACTIONS.get(index);
    ticks = 0;
    goal = goal();
  }

  void stop() {
    action = null;
  }

  /** One step of the action that was begun; false once it is over: see cause(). */
  boolean tick() {
    if (++ticks == TICKS / 2) {
      cause = defect();
      if (!cause.isEmpty()) return false; // the gripper stays where it failed
      move();
    }
    if (ticks == TICKS) action = null;
    return action != null;
  }

  /** Of the failure; empty: none. */
  String cause() {
    return cause;
  }

  boolean done() {
    return putAway == ENOUGH;
  }

  private int placeOf(int block) {
    for (int i = 0; i < 4; ++i) if (places.get(i).contains(block)) return i;
    return NOTHING;
  }

  private String defect() {
    if (!action.take) return lids[action.thing] ? "lid" : bins[action.thing] != NOTHING ? "full" : "";
    int place = placeOf(action.thing);
    if (place == NOTHING) return "gone";
    if (place == (action.side == 0 ? 3 : 0)) return "reach";
    List<Integer> blocks = places.get(place);
    return blocks.get(blocks.size() - 1) == action.thing ? "" : "blocked";
  }

  private void move() {
    if (action.take) {
      hands[action.side] = action.thing;
      places.get(placeOf(action.thing)).remove(Integer.valueOf(action.thing));
    } else {
      bins[action.thing] = hands[action.side];
      hands[action.side] = NOTHING;
      ++putAway;
    }
  }

  /** Corner of the gripper's picture where it acts, or as near as it comes. */
  private int[] goal() {
    if (!action.take) return new int[] {4 + 20 * action.thing, 44};
    int place = placeOf(action.thing);
    if (place == NOTHING) return HOME[action.side];
    int x = action.side == 0 ? Math.min(16 * place, 32) : Math.max(16 * place, 16);
    return new int[] {x, 14 * (1 - places.get(place).indexOf(action.thing)) + 2};
  }

  /** 64x64 pixels, three bytes each. */
  byte[] picture() {
    byte[] pixels = new byte[3 * SIDE * SIDE];
    fill(pixels, 0, 0, SIDE, SIDE, FLOOR);
    fill(pixels, 0, 28, SIDE, 4, cause.isEmpty() ? TABLE : ALARM);
    for (int i = 0; i < 4; ++i)
      for (int level = 0; level < places.get(i).size(); ++level)
        fill(pixels, 16 * i + 1, 14 * (1 - level), 14, 14, PAINT[places.get(i).get(level)]);
    for (int i = 0; i < 3; ++i) {
      fill(pixels, 4 + 20 * i, 48, 16, 16, WALL);
      fill(pixels, 6 + 20 * i, 48, 12, 14, lids[i] ? LID : bins[i] == NOTHING ? FLOOR : PAINT[bins[i]]);
    }
    for (int side = 0; side < 2; ++side) drawGripper(pixels, side);
    return pixels;
  }

  private void drawGripper(byte[] pixels, int side) {
    int x = HOME[side][0], y = HOME[side][1];
    if (action != null && action.side == side) {
      int way = cause.isEmpty() ? Math.min(ticks, TICKS - ticks) : ticks;
      x += Math.floorDiv((goal[0] - x) * way * 2, TICKS);
      y += Math.floorDiv((goal[1] - y) * way * 2, TICKS);
    }
    fill(pixels, x, y - 2, 16, 4, GRIPPER);
    if (hands[side] != NOTHING) fill(pixels, x + 1, y + 2, 14, 10, PAINT[hands[side]]);
  }

  private static void fill(byte[] pixels, int x, int y, int width, int height, int[] colour) {
    for (int row = Math.max(y, 0); row < Math.min(y + height, SIDE); ++row)
      for (int column = Math.max(x, 0); column < Math.min(x + width, SIDE); ++column)
        for (int part = 0; part < 3; ++part) pixels[3 * (row * SIDE + column) + part] = (byte) colour[part];
  }
}
