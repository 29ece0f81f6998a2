// A robot for tests, of whatever task a file describes: grey pictures with a bar for each action
// that was done; every action takes five ticks and succeeds, but for one kind, if one is named.
//
//   made-robot FILE.yaml [--bus URL] [--plan-length N] [--fails KIND] [--judges no]
//   made-robot FILE.yaml --trials N OUT.h5     writes random trials of the task and ends

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "base/run_main.h"
#include "model/dataset.h"
#include "services/common/bus.h"
#include "services/common/clock.h"
#include "services/common/health.h"
#include "services/common/ids.h"
#include "services/common/robot_hold.h"
#include "services/common/signals.h"
#include "services/simulator/scene.h"
#include "tasks/task_file.h"
#include "tools/bench/random_trials.h"

namespace prospect::tests {
namespace {

using namespace services;

constexpr int kTicks = 5;  // of an action

struct Options {
  std::string file, bus, fails, out;
  bool judges = true;  // whether it can tell how its actions ended
  int plan_length = 0, trials = 0;
};

task_t TaskOf(const Options& options) {
  sim::TaskSpec spec = tasks::ReadTaskFile(options.file).spec;
  spec.world_version = "made";
  if (options.plan_length > 0) spec.plan_length = options.plan_length;
  return MakeTaskMessage(spec);
}

class MadeRobot {
 public:
  explicit MadeRobot(const Options& options)
      : options_(options), task_(TaskOf(options)), bus_(options.bus), health_(bus_, "simulator") {
    status_.episode_id = RandomId();
    status_.action = -1;
    status_.state = action_status_t::STATE_IDLE;
    subscriptions_.push_back(
        bus_.Subscribe<health_t>([this](const health_t& h) { hold_.Hear(h, SteadyMs()); }));
    subscriptions_.push_back(
        bus_.Subscribe<action_command_t>([this](const action_command_t& c) { On(c); }));
    health_.SetState(health_t::STATE_READY);
  }

  void Run() {
    Periodic tick(static_cast<std::int64_t>(1000 * task_.tick_seconds)), slow(400);
    while (!StopRequested()) {
      bus_.Poll(10);
      health_.Tick();
      if (hold_.Lapsed(SteadyMs())) Free();
      if (Running() && tick.Due(SteadyMs())) Tick();
      if (slow.Due(SteadyMs())) Repeat();
    }
  }

 private:
  bool Running() const { return status_.state == action_status_t::STATE_RUNNING; }

  void On(const action_command_t& command) {
    std::int64_t& latest = taken_[command.executive_id];
    if (command.command_id <= latest) return;
    latest = command.command_id;
    const bool start = command.kind == action_command_t::KIND_START;
    std::string refusal = hold_.BusyFor(command.executive_id);
    if (start && (command.action < 0 || command.action >= task_.num_actions))
      refusal = "there is no such action";
    if (start && Running()) refusal = "another action is running";
    if (command.episode_id != status_.episode_id) refusal = "meant for another episode";
    const action_status_t before = status_;
    status_.executive_id = command.executive_id;
    status_.command_id = command.command_id;
    status_.reason = refusal;
    if (!refusal.empty()) {
      status_.state = action_status_t::STATE_REFUSED;
      Say();
      if (before.state == action_status_t::STATE_RUNNING) status_ = before;
      return;
    }
    hold_.Take(command.executive_id, SteadyMs());
    status_.state = start       ? action_status_t::STATE_RUNNING
                    : Running() ? action_status_t::STATE_CANCELLED
                                : status_.state;
    if (start) status_.action = command.action, left_ = kTicks;
    Say();
  }

  void Free() {
    hold_.Free();
    if (Running()) status_.state = action_status_t::STATE_CANCELLED;
    Say();
  }

  void Tick() {
    ++status_.frame;
    const action_t& action = task_.actions[static_cast<std::size_t>(status_.action)];
    if (--left_ == 0) {
      const bool fails = action.kind == options_.fails;
      status_.state = fails ? action_status_t::STATE_FAILED : action_status_t::STATE_SUCCEEDED;
      status_.reason = fails && !task_.causes.empty() ? task_.causes[0].name : "";
      if (!options_.judges) status_.state = action_status_t::STATE_ENDED, status_.reason.clear();
      done_.push_back(status_.action);
    }
    Look();
    Say();
  }

  void Repeat() {
    task_.utime = UtimeNow();
    bus_.Publish(task_);
    Look();
    Say();
  }

  void Say() {
    status_.utime = UtimeNow();
    status_.holder_id = hold_.holder();
    bus_.Publish(status_);
  }

  void Look() {
    observation_t o{};
    o.utime = UtimeNow();
    o.episode_id = status_.episode_id;
    o.frame = status_.frame;
    o.sim_time_us =
        static_cast<std::int64_t>(1e6 * task_.tick_seconds * static_cast<double>(status_.frame));
    o.encoding = observation_t::ENCODING_RGB8;
    o.width = task_.image_width;
    o.height = task_.image_height;
    o.data.assign(
        std::size_t{3} * static_cast<std::size_t>(o.width) * static_cast<std::size_t>(o.height),
        120);
    for (const int action : done_) Fill(&o, 12 * action + 4, 200);
    if (Running()) Fill(&o, 12 * status_.action + 4, static_cast<std::uint8_t>(40 + 10 * left_));
    o.num_bytes = static_cast<std::int32_t>(o.data.size());
    bus_.Publish(o);
  }

  // A bar across the picture, as far as it reaches.
  static void Fill(observation_t* o, int row, std::uint8_t shade) {
    const auto line = std::size_t{3} * static_cast<std::size_t>(o->width);
    const std::size_t begin = static_cast<std::size_t>(row % o->height) * line;
    std::fill_n(o->data.begin() + static_cast<std::ptrdiff_t>(begin), line, shade);
  }

  Options options_;
  task_t task_;
  Bus bus_;
  HealthBeacon health_;
  RobotHold hold_;
  action_status_t status_{};
  std::map<std::int64_t, std::int64_t> taken_;
  std::vector<int> done_;
  int left_ = 0;
  std::vector<Subscription> subscriptions_;
};

// Of seeds from 0 on, so that every part of the data has some.
void WriteTrials(const Options& options) {
  const sim::TaskSpec spec = tasks::ReadTaskFile(options.file).spec;
  std::vector<std::string> parts;
  for (int seed = 0; seed < options.trials; ++seed) {
    parts.push_back(options.out + "." + std::to_string(seed));
    model::WriteTrialFile(parts.back(), tools::RandomTrial(spec, static_cast<std::uint64_t>(seed)));
  }
  model::PackTrialFiles(parts, options.out);
  for (const std::string& part : parts) std::filesystem::remove(part);
}

int Run(int argc, char** argv) {
  Options options;
  options.file = argc > 1 ? argv[1] : "";
  for (int i = 2; i + 1 < argc; i += 2) {
    const std::string name = argv[i];
    if (name == "--bus") options.bus = argv[i + 1];
    if (name == "--judges") options.judges = std::string(argv[i + 1]) != "no";
    if (name == "--fails") options.fails = argv[i + 1];
    if (name == "--plan-length") options.plan_length = std::atoi(argv[i + 1]);
    if (name == "--trials" && i + 2 < argc)
      options.trials = std::atoi(argv[i + 1]), options.out = argv[i + 2];
  }
  if (options.trials > 0) {
    WriteTrials(options);
    return kExitSuccess;
  }
  InstallStopSignals();
  MadeRobot(options).Run();
  return kExitSuccess;
}

}  // namespace
}  // namespace prospect::tests

int main(int argc, char** argv) {
  return prospect::RunMain([&] { return prospect::tests::Run(argc, argv); });
}
