// A robot in the simulator's place, with nothing but LCM and the generated message types: the
// sorting table of world.h on the bus. Put a camera and controllers in the place of World.
// ./prospect check-robot tells whether a robot keeps to the rules.
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <lcm/lcm-cpp.hpp>
#include <map>
#include <optional>
#include <random>
#include <string>

#include "examples/keyed/keyed.h"
#include "prospect/action_command_t.hpp"
#include "prospect/action_status_t.hpp"
#include "prospect/health_t.hpp"
#include "prospect/label_t.hpp"
#include "prospect/observation_t.hpp"
#include "prospect/sim_command_t.hpp"
#include "prospect/task_t.hpp"
#include "services/common/host_filter.h"
#include "world.h"

using namespace prospect;

// Microseconds; kFastest: what a recorder can follow.
constexpr std::int64_t kTick = 500'000, kFastest = 2'000, kSilent = 3'000'000;

// The wall clock may jump: it stamps messages, and all time-outs go by the steady one.
template <class Clock>
std::int64_t Microseconds() {
  const auto since = Clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::microseconds>(since).count();
}
std::int64_t Now() { return Microseconds<std::chrono::steady_clock>(); }

std::int64_t AnyId() {
  std::random_device random;
  return (static_cast<std::int64_t>(random() >> 2) << 32 | random()) + 1;
}

class Robot {
 public:
  // LCM opens its socket at the first subscription; the filter keeps out what would end it.
  Robot(const std::string& bus, const std::string& key_file, double speed)
      : filter_(bus),
        lcm_(bus),
        tick_(std::max<std::int64_t>(kFastest, speed > 0 ? std::llround(kTick / speed) : 0)) {
    if (!key_file.empty()) key_.emplace(key_file);
    lcm_.subscribe("ACTION_COMMAND", &Robot::Hear<action_command_t>, this);
    lcm_.subscribe("SIM_COMMAND", &Robot::Hear<sim_command_t>, this);
    lcm_.subscribe("HEALTH", &Robot::Hear<health_t>, this);
    if (!filter_.InForce()) throw std::runtime_error("the bus cannot be opened: " + bus);
    BeginEpisode(AnyId(), 0, 0);
  }

  void Run() {
    std::int64_t due = Now();
    for (int half_seconds = 0;;) {
      if (running() && Now() >= next_tick_) Tick();
      WatchHolder();
      if (Now() >= due) {  // at least at 2 Hz, and once a second
        due = Now() + 500'000;
        Publish("ACTION_STATUS", &status_);
        if (half_seconds++ % 2 == 0) SayHealth(), SayTask(), Look();
      }
      const std::int64_t wait = (running() ? std::min(due, next_tick_) : due) - Now();
      if (lcm_.handleTimeout(static_cast<int>(std::max<std::int64_t>(wait, 0) / 1000)) < 0) return;
    }
  }

 private:
  bool running() const { return status_.state == action_status_t::STATE_RUNNING; }
  bool HeldByAnother(std::int64_t id) const { return status_.holder_id && status_.holder_id != id; }

  void BeginEpisode(std::int64_t episode, std::int64_t seed, std::int64_t holder) {
    world_ = sorting::World(static_cast<std::uint64_t>(seed));
    status_ = action_status_t{};
    status_.episode_id = episode, status_.holder_id = holder, status_.action = -1;
    status_.state = action_status_t::STATE_IDLE;
    status_.outcome = label_t::OUTCOME_RUNNING;
    heard_ = Now();
  }

  // With a key, who does not have it is not heard.
  template <class T>
  void Hear(const lcm::ReceiveBuffer* buffer, const std::string& channel) {
    const auto* data = static_cast<const std::uint8_t*>(buffer->data);
    Keyed::Bytes bytes(data, data + buffer->data_size);
    if (key_ && !key_->Verify(channel, &bytes)) return;
    T message{};
    const int size = static_cast<int>(bytes.size());
    if (message.decode(bytes.data(), 0, size) == size) On(message);
  }

  // Each command is carried out once, however often it arrives: the ids of a sender grow.
  static bool IsNew(std::map<std::int64_t, std::int64_t>* taken, std::int64_t sender,
                    std::int64_t id) {
    std::int64_t& latest = taken->try_emplace(sender, -1).first->second;
    if (id <= latest) return false;
    latest = id;
    return true;
  }

  void On(const action_command_t& c) {
    if (!IsNew(&actions_, c.executive_id, c.command_id)) return Publish("ACTION_STATUS", &status_);
    const bool start = c.kind == action_command_t::KIND_START;
    std::string refusal = start ? world_.Refusal(c.action) : "";
    if (start && running()) refusal = "another action is running";
    if (c.episode_id != status_.episode_id)
      refusal = "meant for another episode: here is " + std::to_string(status_.episode_id);
    const bool busy = HeldByAnother(c.executive_id);
    if (busy) refusal = "busy, held by executive " + std::to_string(status_.holder_id);
    const action_status_t before = status_;
    status_.executive_id = c.executive_id;
    status_.command_id = c.command_id;
    status_.reason = refusal;
    if (!refusal.empty()) {
      status_.state = action_status_t::STATE_REFUSED;
    } else if (start) {
      Start(c);
    } else if (running()) {
      Stop();
    }
    Publish("ACTION_STATUS", &status_);
    // A refusal while an action runs or another holds the robot is told once, and changes nothing.
    if (!refusal.empty() && (busy || before.state == action_status_t::STATE_RUNNING))
      status_ = before;
  }

  void Start(const action_command_t& c) {
    world_.Begin(c.action);
    status_.action = c.action, status_.holder_id = c.executive_id;
    status_.state = action_status_t::STATE_RUNNING;
    heard_ = next_tick_ = Now();
  }

  void Stop() {
    world_.Stop();
    status_.state = action_status_t::STATE_CANCELLED;
  }

  // A new scene, as a simulator puts it up; a robot that cannot tidy its table begins an episode
  // with what lies there.
  void On(const sim_command_t& c) {
    if (c.kind != sim_command_t::KIND_RESET || !IsNew(&resets_, c.sender_id, c.command_id)) return;
    if (!HeldByAnother(c.sender_id) && c.present_episode_id == status_.episode_id) {
      BeginEpisode(c.episode_id, c.seed, c.sender_id);
      Look();
    }
    Publish("ACTION_STATUS", &status_);
  }

  void On(const health_t& h) {
    if (h.instance_id != status_.holder_id) return;
    heard_ = h.state == health_t::STATE_DRAINING ? Now() - 2 * kSilent : Now();  // it leaves
  }

  void WatchHolder() {
    if (status_.holder_id == 0 || Now() - heard_ <= kSilent) return;
    if (running()) Stop();
    status_.holder_id = 0;  // free for another executive
    Publish("ACTION_STATUS", &status_);
  }

  void Tick() {
    next_tick_ = Now() + tick_;
    ++status_.frame;
    status_.sim_time_us = kTick * status_.frame;
    const bool goes_on = world_.Tick();
    Look();
    if (goes_on) return;
    status_.reason = world_.cause();
    const bool failed = !status_.reason.empty();
    status_.state = failed ? action_status_t::STATE_FAILED : action_status_t::STATE_SUCCEEDED;
    if (failed) status_.outcome = label_t::OUTCOME_FAILURE;
    if (world_.done()) status_.outcome = label_t::OUTCOME_SUCCESS;
    Publish("ACTION_STATUS", &status_);
  }

  void Look() {
    observation_t o{0, status_.sim_time_us, status_.episode_id, status_.frame};
    o.encoding = observation_t::ENCODING_RGB8;
    o.width = o.height = sorting::kPixels;
    o.data = world_.Picture();
    o.num_bytes = static_cast<std::int32_t>(o.data.size());
    Publish("OBSERVATION", &o);
  }

  void SayHealth() {
    health_t h{0, "simulator", id_};  // whose place it takes
    h.pid = getpid();
    h.state = running() ? health_t::STATE_BUSY : health_t::STATE_READY;
    Publish("HEALTH", &h);
  }

  void SayTask() {
    task_t t{};
    t.name = "sorting", t.world_version = "1", t.task_hash = 1;  // change them with the table
    for (const sorting::Action& action : sorting::kActions) {
      const std::string kind = Kind(action), thing = Thing(action);
      t.actions.push_back({t.num_actions++, kind + "(" + thing + ")", kind, thing});
      action_t& row = t.actions.back();
      row.successors = action.take ? sorting::kPuts[action.side] : sorting::kTakes;
      row.num_successors = static_cast<std::int32_t>(row.successors.size());
    }
    t.initial = sorting::kTakes;
    t.num_initial = static_cast<std::int32_t>(t.initial.size());
    t.plan_length = sorting::kPlanLength;
    t.image_width = t.image_height = sorting::kPixels;
    t.tick_seconds = 1e-6 * kTick;
    t.action_time_limit = 2 * sorting::kTicks * t.tick_seconds;
    for (const auto& [name, words] : sorting::kCauses) t.causes.push_back({name, words});
    t.num_causes = static_cast<std::int32_t>(t.causes.size());
    Publish("TASK", &t);
  }

  template <class T>
  void Publish(const char* channel, T* message) {
    message->utime = Microseconds<std::chrono::system_clock>();
    Keyed::Bytes bytes(static_cast<std::size_t>(message->getEncodedSize()));
    message->encode(bytes.data(), 0, static_cast<int>(bytes.size()));
    if (key_) bytes = key_->Sign(channel, bytes);
    lcm_.publish(channel, bytes.data(), static_cast<unsigned>(bytes.size()));
  }

  prospect::services::HostFilter filter_;
  lcm::LCM lcm_;
  std::optional<Keyed> key_;  // none: an open bus, where whoever can send moves this robot
  const std::int64_t id_ = AnyId(), tick_;
  sorting::World world_{0};
  action_status_t status_{};
  std::map<std::int64_t, std::int64_t> actions_, resets_;  // latest command of each sender
  std::int64_t heard_ = 0, next_tick_ = 0;
};

int Usage(int code) {
  std::printf(
      "usage: example-robot [--bus URL] [--key FILE] [--speed FACTOR]\n"
      "--speed 1: as a clock runs (the default); 0: as fast as it can\n");
  return code;
}

int main(int argc, char** argv) {
  const char* const key = std::getenv("PROSPECT_KEY_FILE");
  const char* const url = std::getenv("LCM_DEFAULT_URL");
  std::map<std::string, std::string> options = {
      {"--bus", url ? url : "udpm://239.255.76.67:7667?ttl=0"},
      {"--key", key ? key : ""},
      {"--speed", "1"}};
  for (int i = 1; i < argc; i += 2) {
    if (std::string(argv[i]) == "--help") return Usage(0);
    if (options.count(argv[i]) == 0 || i + 1 == argc) return Usage(2);
    options[argv[i]] = argv[i + 1];
  }
  try {
    Robot(options["--bus"], options["--key"], std::stod(options["--speed"])).Run();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 2;
  }
  return 11;
}
