// A robot in the simulator's place, with nothing but LCM and the generated message types: a toy
// rover among four things, seen from above. Put a camera into Look() and controllers into Drive().
// ./prospect check-robot tells whether a robot keeps to the rules.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <lcm/lcm-cpp.hpp>
#include <map>
#include <optional>
#include <string>

#include "examples/keyed/keyed.h"
#include "prospect/action_command_t.hpp"
#include "prospect/action_status_t.hpp"
#include "prospect/health_t.hpp"
#include "prospect/observation_t.hpp"
#include "prospect/task_t.hpp"
#include "services/common/host_filter.h"

using namespace prospect;

constexpr int kSide = 64, kHere = 4;
constexpr std::int64_t kTick = 100'000, kSilent = 3'000'000, kLimit = 10'000'000;  // microseconds
const char* const kLate = "time";
const char* const kThings[] = {"barrel", "barricade", "pylon", "block",
                               "spool",  "generator", "cabin"};
const double kWhere[kHere][2] = {{14, 50}, {50, 48}, {48, 14}, {16, 16}};  // pixels

// The wall clock may jump: it stamps messages, and all time-outs go by the steady one.
template <class Clock>
std::int64_t Microseconds() {
  const auto since = Clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::microseconds>(since).count();
}
std::int64_t Now() { return Microseconds<std::chrono::steady_clock>(); }
std::int64_t Utime() { return Microseconds<std::chrono::system_clock>(); }

class Robot {
 public:
  // LCM opens its socket at the first subscription; the filter keeps out what would end it.
  Robot(const std::string& bus, const std::string& key_file) : filter_(bus), lcm_(bus) {
    if (!key_file.empty()) key_.emplace(key_file);
    lcm_.subscribe("ACTION_COMMAND", &Robot::Hear<action_command_t>, this);
    lcm_.subscribe("HEALTH", &Robot::Hear<health_t>, this);
    if (!filter_.InForce()) throw std::runtime_error("the bus cannot be opened: " + bus);
    status_.episode_id = id_ / 1'000'000;  // any number that names this episode
    status_.action = -1;
    status_.state = action_status_t::STATE_IDLE;
  }

  void Run() {
    for (std::int64_t next = Now(); lcm_.handleTimeout(10) >= 0;) {
      if (Now() < next) continue;
      next += kTick;
      Tick();
    }
  }

 private:
  bool running() const { return status_.state == action_status_t::STATE_RUNNING; }

  // With a key, who does not have it is not heard.
  template <class T>
  void Hear(const lcm::ReceiveBuffer* buffer, const std::string& channel) {
    const auto* data = static_cast<const std::uint8_t*>(buffer->data);
    Keyed::Bytes bytes(data, data + buffer->data_size);
    if (key_ && !key_->Verify(channel, &bytes)) return;
    T message{};
    const int size = static_cast<int>(bytes.size());
    if (message.decode(bytes.data(), 0, size) == size) On(&message);
  }

  // A command is carried out once, however often it arrives: the ids of an executive grow.
  void On(const action_command_t* c) {
    std::int64_t& latest = taken_[c->executive_id];
    if (c->command_id <= latest) return;
    latest = c->command_id;
    const bool start = c->kind == action_command_t::KIND_START;
    std::string refusal;
    if (start && (c->action < 0 || c->action >= kHere)) refusal = "there is no such thing here";
    if (start && running()) refusal = "another action is running";
    if (c->episode_id != status_.episode_id) refusal = "meant for another episode";
    // Whoever's command was carried out first holds the robot; others are told so.
    const bool busy = status_.holder_id != 0 && status_.holder_id != c->executive_id;
    if (busy) refusal = "busy, held by executive " + std::to_string(status_.holder_id);
    const action_status_t before = status_;
    status_.executive_id = c->executive_id;
    status_.command_id = c->command_id;
    status_.reason = refusal;
    if (start) status_.state = action_status_t::STATE_RUNNING;
    if (!start && running()) status_.state = action_status_t::STATE_CANCELLED;
    if (!refusal.empty()) status_.state = action_status_t::STATE_REFUSED;
    if (start && refusal.empty()) {
      status_.action = c->action, status_.holder_id = c->executive_id;
      began_ = heard_ = Now();
    }
    Publish("ACTION_STATUS", &status_);
    const bool apart = busy || before.state == action_status_t::STATE_RUNNING;
    if (!refusal.empty() && apart) status_ = before;
  }

  void On(const health_t* h) {
    if (h->instance_id != status_.holder_id) return;
    heard_ = h->state == health_t::STATE_DRAINING ? Now() - 2 * kSilent : Now();  // it leaves
  }

  void Tick() {
    if (running()) {
      ++status_.frame;
      if (!Drive()) status_.state = action_status_t::STATE_SUCCEEDED;
      if (Now() - began_ > kLimit)
        status_.state = action_status_t::STATE_FAILED, status_.reason = kLate;
      if (Now() - heard_ > kSilent) status_.state = action_status_t::STATE_CANCELLED;
      Look();
      Publish("ACTION_STATUS", &status_);  // at every change, and at least at 2 Hz
    }
    if (Now() - heard_ > kSilent) status_.holder_id = 0;  // free for another executive
    if (ticks_++ % 5 == 0) Publish("ACTION_STATUS", &status_);
    if (ticks_ % 10 != 1) return;
    Look();  // the last picture again
    SayHealth();
    SayTask();
  }

  bool Drive() {  // a step towards the thing; false once it is near
    const double dx = kWhere[status_.action][0] - x_, dy = kWhere[status_.action][1] - y_;
    const double away = std::hypot(dx, dy);
    x_ += 0.45 * dx / away, y_ += 0.45 * dy / away;
    return away > 10;
  }

  void Look() {
    observation_t o{0, Now() - start_, status_.episode_id, status_.frame};
    o.encoding = observation_t::ENCODING_RGB8;
    o.width = o.height = kSide, o.num_bytes = kSide * kSide * 3;
    for (int i = 0; i < kSide * kSide; ++i) {
      const int x = i % kSide, y = i / kSide;
      std::uint8_t grey = std::hypot(x - x_, y - y_) < 5 ? 60 : 150;
      for (const auto& at : kWhere) grey = std::hypot(x - at[0], y - at[1]) < 4 ? 220 : grey;
      o.data.insert(o.data.end(), 3, grey);
    }
    Publish("OBSERVATION", &o);
  }

  void SayHealth() {
    health_t h{0, "simulator", id_};  // whose place it takes
    h.state = health_t::STATE_READY;
    Publish("HEALTH", &h);
  }

  void SayTask() {
    task_t t{};
    t.name = "navigation";
    t.task_hash = 4711;  // any number that changes with the table
    t.num_actions = t.num_initial = 7;
    for (int i = 0; i < t.num_actions; ++i) {
      t.actions.push_back({i, std::string("investigate(") + kThings[i] + ")", "investigate"});
      t.actions[i].object = kThings[i];
      t.actions[i].num_successors = t.num_actions;
      t.initial.push_back(i);
    }
    for (action_t& action : t.actions) action.successors = t.initial;  // any may follow any
    t.plan_length = 3;
    t.image_width = t.image_height = kSide;
    t.tick_seconds = 0.1;
    t.action_time_limit = 10;
    t.causes = {{kLate, "it ran out of time"}};  // what may go wrong, in words for people
    t.num_causes = static_cast<std::int32_t>(t.causes.size());
    Publish("TASK", &t);
  }

  template <class T>
  void Publish(const char* channel, T* message) {
    message->utime = Utime();
    Keyed::Bytes bytes(static_cast<std::size_t>(message->getEncodedSize()));
    message->encode(bytes.data(), 0, static_cast<int>(bytes.size()));
    if (key_) bytes = key_->Sign(channel, bytes);
    lcm_.publish(channel, bytes.data(), static_cast<unsigned>(bytes.size()));
  }

  prospect::services::HostFilter filter_;
  lcm::LCM lcm_;
  std::optional<Keyed> key_;  // none: an open bus, where whoever can send moves this robot
  const std::int64_t id_ = Utime(), start_ = Now();
  action_status_t status_{};
  std::map<std::int64_t, std::int64_t> taken_;  // latest command of each executive, refused or not
  std::int64_t began_ = 0, heard_ = 0;
  int ticks_ = 0;
  double x_ = 32, y_ = 32;
};

int main(int argc, char** argv) {
  const char* const key = std::getenv("PROSPECT_KEY_FILE");
  const char* const url = std::getenv("LCM_DEFAULT_URL");
  std::string bus = url ? url : "udpm://239.255.76.67:7667?ttl=0", key_file = key ? key : "";
  for (int i = 1; i < argc; i += 2) {
    const std::string option = argv[i];
    if ((option != "--bus" && option != "--key") || i + 1 == argc) {
      std::printf("usage: example-robot [--bus URL] [--key FILE]\n");
      return option == "--help" ? 0 : 2;
    }
    (option == "--bus" ? bus : key_file) = argv[i + 1];
  }
  try {
    Robot(bus, key_file).Run();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 2;
  }
  return 11;
}
