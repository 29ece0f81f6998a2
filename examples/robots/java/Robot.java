import java.io.IOException;
import java.nio.file.Path;
import java.security.SecureRandom;
import java.util.HashMap;
import java.util.Map;
import java.util.concurrent.BlockingQueue;
import java.util.concurrent.LinkedBlockingQueue;
import java.util.concurrent.TimeUnit;
import lcm.lcm.LCM;
import lcm.lcm.LCMDataInputStream;
import lcm.lcm.LCMDataOutputStream;
import lcm.lcm.LCMEncodable;
import prospect.action_command_t;
import prospect.action_status_t;
import prospect.action_t;
import prospect.cause_t;
import prospect.health_t;
import prospect.label_t;
import prospect.observation_t;
import prospect.sim_command_t;
import prospect.task_t;

/**
 * A robot in the simulator's place, with LCM's jar and the message types alone: the sorting table of World on the bus. Put a camera
 * and controllers in the place of World. ./prospect check-robot tells whether a robot keeps to the rules.
 *
 * <p>LCM hears on a thread of its own, which only puts messages into a queue: everything else is one thread's.
 */
public final class Robot {
  // Nanoseconds; FASTEST: what a recorder can follow.
  private static final long TICK = 500_000_000, FASTEST = 2_000_000, SILENT = 3_000_000_000L;

  /** Makes a message of one type from its bytes. */
  private interface Decoder<T> {
    T from(LCMDataInputStream bytes) throws IOException;
  }

  private interface Handler<T> {
    void on(T message) throws IOException;
  }

  private interface Heard {
    void handle() throws IOException;
  }

  private final LCM lcm;
  private final Keyed key; // null: an open bus, where whoever can send moves this robot
  private final BlockingQueue<Heard> heard = new LinkedBlockingQueue<>();
  private final long id = anyId(), tick;
  private final Map<Long, Long> commands = new HashMap<>(), resets = new HashMap<>(); // latest one of each sender
  private World world;
  private action_status_t status;
  private long holderHeard, nextTick;

  Robot(String bus, Keyed key, double speed) throws IOException {
    this.key = key;
    tick = Math.max(FASTEST, speed > 0 ? (long) (TICK / speed) : 0);
    lcm = new LCM(bus);
    beginEpisode(anyId(), 0, 0);
    subscribe("ACTION_COMMAND", action_command_t::new, this::onAction);
    subscribe("SIM_COMMAND", sim_command_t::new, this::onReset);
    subscribe("HEALTH", health_t::new, this::onHealth);
  }

  private static long anyId() {
    return (new SecureRandom().nextLong() >>> 2) + 1;
  }

  /** With a key, who does not have it is not heard. */
  private <T> void subscribe(String channel, Decoder<T> decoder, Handler<T> handler) {
    lcm.subscribe(channel, (bus, name, data) -> {
      try {
        byte[] bytes = new byte[data.available()];
        data.readFully(bytes);
        heard.add(() -> hear(channel, bytes, decoder, handler));
      } catch (IOException impossible) {
        throw new IllegalStateException(impossible);
      }
    });
  }

  private <T> void hear(String channel, byte[] bytes, Decoder<T> decoder, Handler<T> handler) throws IOException {
    byte[] known = key == null ? bytes : key.verify(channel, bytes);
    if (known == null) return;
    LCMDataInputStream rest = new LCMDataInputStream(known);
    T message;
    try {
      message = decoder.from(rest);
    } catch (IOException | RuntimeException noMessage) {
      return;
    }
    if (rest.available() == 0) handler.on(message);
  }

  void run() throws IOException, InterruptedException {
    long due = System.nanoTime();
    for (int halfSeconds = 0;;) {
      if (running() && System.nanoTime() - nextTick >= 0) tick();
      watchHolder();
      if (System.nanoTime() - due >= 0) { // at least at 2 Hz, and once a second
        due = System.nanoTime() + 500_000_000;
        say("ACTION_STATUS", status);
        if (halfSeconds++ % 2 == 0) {
          sayHealth();
          sayTask();
          look();
        }
      }
      long now = System.nanoTime(), wait = running() ? Math.min(due - now, nextTick - now) : due - now;
      Heard next = heard.poll(Math.max(wait, 0), TimeUnit.NANOSECONDS);
      if (next != null) next.handle();
    }
  }

  private boolean running() {
    return status.state == action_status_t.STATE_RUNNING;
  }

  private boolean heldByAnother(long sender) {
    return status.holder_id != 0 && status.holder_id != sender;
  }

  private void beginEpisode(long episode, long seed, long holder) {
    world = new World(seed);
    status = new action_status_t();
    status.episode_id = episode;
    status.holder_id = holder;
    status.action = -1;
    status.state = action_status_t.STATE_IDLE;
    status.outcome = label_t.OUTCOME_RUNNING;
    status.reason = "";
    holderHeard = System.nanoTime();
  }

  /** Each command is carried out once, however often it arrives: the ids of a sender grow. */
  private static boolean isNew(Map<Long, Long> taken, long sender, long command) {
    if (command <= taken.getOrDefault(sender, -1L)) return false;
    taken.put(sender, command);
    return true;
  }

  private void onAction(action_command_t command) throws IOException {
    if (!isNew(commands, command.executive_id, command.command_id)) {
      say("ACTION_STATUS", status);
      return;
    }
    boolean start = command.kind == action_command_t.KIND_START, busy = heldByAnother(command.executive_id);
    String refusal = start ? world.refusal(command.action) : "";
    if (start && running()) refusal = "another action is running";
    if (command.episode_id != status.episode_id) refusal = "meant for another episode: here is " + status.episode_id;
    if (busy) refusal = "busy, held by executive " + status.holder_id;
    action_status_t before = status.copy();
    status.executive_id = command.executive_id;
    status.command_id = command.command_id;
    status.reason = refusal;
    boolean apart = busy || running();
    if (!refusal.isEmpty()) status.state = action_status_t.STATE_REFUSED;
    else if (start) start(command);
    else if (running()) stop();
    say("ACTION_STATUS", status);
    // A refusal while an action runs or another holds the robot is told once, and changes nothing.
    if (!refusal.isEmpty() && apart) status = before;
  }

  private void start(action_command_t command) {
    world.begin(command.action);
    status.action = command.action;
    status.holder_id = command.executive_id;
    status.state = action_status_t.STATE_RUNNING;
    holderHeard = nextTick = System.nanoTime();
  }

  private void stop() {
    world.stop();
    status.state = action_status_t.STATE_CANCELLED;
  }

  /** A new scene, as a simulator puts it up; a robot that cannot tidy its table begins an episode with what lies there. */
  private void onReset(sim_command_t command) throws IOException {
    if (command.kind != sim_command_t.KIND_RESET || !isNew(resets, command.sender_id, command.command_id)) return;
    if (!heldByAnother(command.sender_id) && command.present_episode_id == status.episode_id) {
      beginEpisode(command.episode_id, command.seed, command.sender_id);
      look();
    }
    say("ACTION_STATUS", status);
  }

  private void onHealth(health_t health) {
    if (health.instance_id != status.holder_id) return;
    boolean leaves = health.state == health_t.STATE_DRAINING;
    holderHeard = System.nanoTime() - (leaves ? 2 * SILENT : 0);
  }

  private void watchHolder() throws IOException {
    if (status.holder_id == 0 || System.nanoTime() - holderHeard <= SILENT) return;
    if (running()) stop();
    status.holder_id = 0; // free for another executive
    say("ACTION_STATUS", status);
  }

  private void tick() throws IOException {
    nextTick = System.nanoTime() + tick;
    ++status.frame;
    status.sim_time_us = TICK / 1000 * status.frame;
    boolean goesOn = world.tick();
    look();
    if (goesOn) return;
    status.reason = world.cause();
    boolean failed = !status.reason.isEmpty();
    status.state = failed ? action_status_t.STATE_FAILED : action_status_t.STATE_SUCCEEDED;
    if (failed) status.outcome = label_t.OUTCOME_FAILURE;
    if (world.done()) status.outcome = label_t.OUTCOME_SUCCESS;
    say("ACTION_STATUS", status);
  }

  private static long utime() {
    return System.currentTimeMillis() * 1000;
  }

  private void look() throws IOException {
    observation_t picture = new observation_t();
    picture.utime = utime();
    picture.sim_time_us = status.sim_time_us;
    picture.episode_id = status.episode_id;
    picture.frame = status.frame;
    picture.encoding = observation_t.ENCODING_RGB8;
    picture.width = picture.height = World.SIDE;
    picture.data = world.picture();
    picture.num_bytes = picture.data.length;
    say("OBSERVATION", picture);
  }

  private void sayHealth() throws IOException {
    health_t health = new health_t();
    health.utime = utime();
    health.service = "simulator"; // whose place it takes
    health.instance_id = id;
    health.pid = (int) ProcessHandle.current().pid();
    health.host = health.message = "";
    health.state = running() ? health_t.STATE_BUSY : health_t.STATE_READY;
    health.counters = new prospect.counter_t[0];
    say("HEALTH", health);
  }

  private void sayTask() throws IOException {
    task_t task = new task_t();
    task.utime = utime();
    task.name = "sorting";
    task.world_version = "1";
    task.task_hash = 1; // change them with the table
    task.num_actions = World.ACTIONS.size();
    task.actions = new action_t[task.num_actions];
    for (int i = 0; i < task.num_actions; ++i) task.actions[i] = row(i, World.ACTIONS.get(i));
    task.initial = World.TAKES;
    task.num_initial = task.initial.length;
    task.plan_length = World.PLAN_LENGTH;
    task.image_width = task.image_height = World.SIDE;
    task.tick_seconds = 1e-9 * TICK;
    task.action_time_limit = 2 * World.TICKS * task.tick_seconds;
    task.num_causes = World.CAUSES.length;
    task.causes = new cause_t[task.num_causes];
    for (int i = 0; i < task.num_causes; ++i) {
      task.causes[i] = new cause_t();
      task.causes[i].name = World.CAUSES[i][0];
      task.causes[i].words = World.CAUSES[i][1];
    }
    say("TASK", task);
  }

  private static action_t row(int index, World.Action action) {
    action_t row = new action_t();
    row.index = index;
    row.kind = action.kind();
    row.object = action.object();
    row.name = row.kind + "(" + row.object + ")";
    row.successors = action.successors();
    row.num_successors = row.successors.length;
    return row;
  }

  private void say(String channel, LCMEncodable message) throws IOException {
    if (message == status) status.utime = utime();
    LCMDataOutputStream bytes = new LCMDataOutputStream();
    message.encode(bytes);
    byte[] data = bytes.toByteArray();
    if (key != null) data = key.sign(channel, data);
    lcm.publish(channel, data, 0, data.length);
  }

  public static void main(String[] arguments) throws Exception {
    Map<String, String> options = new HashMap<>(Map.of("--speed", "1"));
    options.put("--bus", System.getenv().getOrDefault("LCM_DEFAULT_URL", "udpm://239.255.76.67:7667?ttl=0"));
    options.put("--key", System.getenv().getOrDefault("PROSPECT_KEY_FILE", ""));
    for (int i = 0; i < arguments.length; i += 2) {
      if (!options.containsKey(arguments[i]) || i + 1 == arguments.length) {
        System.err.println("usage: Robot [--bus URL] [--key FILE] [--speed FACTOR]");
        System.err.println("--speed 1: as a clock runs (the default); 0: as fast as it can");
        System.exit(2);
      }
      options.put(arguments[i], arguments[i + 1]);
    }
    String file = options.get("--key");
    Keyed key = file.isEmpty() ? null : new Keyed(Path.of(file));
    new Robot(options.get("--bus"), key, Double.parseDouble(options.get("--speed"))).run();
  }
}
