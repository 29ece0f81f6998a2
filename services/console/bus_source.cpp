#include "services/console/bus_source.h"

#include <signal.h>
#include <spdlog/spdlog.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "services/binding/evaluation_messages.h"
#include "services/binding/task_messages.h"
#include "services/common/clock.h"
#include "services/common/ids.h"
#include "services/console/page_values.h"

namespace prospect::services::console {
namespace {

using nlohmann::json;

// A command id that none of the executive's own will reach: whoever is told to stop by it obeys
// nothing more of that executive, and the executive reads in the status that it was stopped.
constexpr std::int64_t kLastCommand = 1 << 20;

// So long a press of stop holds: CANCEL is said again in case it was lost, and to a holder of whom
// nothing was known yet.
constexpr std::int64_t kStopMs = 1000;

std::string HostName() {
  char name[256] = {};
  return gethostname(name, sizeof name - 1) == 0 ? name : "";
}

// Whether `pid` is an executive of this user on this machine: what HEALTH says of a process is
// looked at before a signal goes there.
bool IsExecutiveHere(int pid) {
  std::error_code none;
  const std::string folder = "/proc/" + std::to_string(pid);
  struct stat status {};
  if (pid <= 1 || stat(folder.c_str(), &status) != 0 || status.st_uid != getuid()) return false;
  const auto program = std::filesystem::read_symlink(folder + "/exe", none);
  return !none && program.filename() == "prospect-executive";
}

int ParentOf(int pid) {
  std::ifstream status("/proc/" + std::to_string(pid) + "/status");
  for (std::string word; status >> word;) {
    int parent = -1;
    if (word == "PPid:" && status >> parent) return parent;
  }
  return -1;
}

}  // namespace

BusSource::BusSource(const BusSourceOptions& options, std::function<void()> notify)
    : options_(options),
      notify_(std::move(notify)),
      model_(options.memory_bytes),
      bus_(options.bus),
      health_(bus_, "console"),
      client_id_(health_.instance_id()),
      asker_(client_id_, [this](const predict_request_t& request) { bus_.Publish(request); }),
      starter_(bus_.url(), options.out) {
  subscription_ = bus_.SubscribeAll([this](const RawMessage& message) {
    const BusEvent event{message.received_utime, message.channel, message.bytes,
                         message.refused ? message.refused : ""};
    const std::lock_guard<std::mutex> lock(mutex());
    model_.Take(event);
    if (event.channel != ChannelOf<predict_reply_t>() || !event.refused.empty()) return;
    const auto reply =
        messages::CheckedDecode<predict_reply_t>(event.bytes.data(), event.bytes.size());
    if (reply.ok()) asker_.Hear(reply.value);
  });
  thread_ = std::thread([this] { Listen(); });
}

BusSource::~BusSource() {
  stopping_ = true;
  bus_.Wake();
  thread_.join();
}

void BusSource::Listen() try {
  health_.SetState(health_t::STATE_READY);
  while (!stopping_) {
    if (bus_.Poll(200) > 0) notify_();
    health_.Tick();
  }
  health_.SetState(health_t::STATE_DRAINING, "leaving");
  health_.PublishNow();
} catch (const std::exception& error) {
  spdlog::error("the bus cannot be heard any more: {}", error.what());
  failed_ = true;
}

void BusSource::WantPicture(std::int64_t search_id, const planner::Path& path, bool urgent) {
  const std::lock_guard<std::mutex> lock(mutex());
  const SearchView* search = model_.Find(search_id);
  if (!search || !search->Legal(path)) return;
  if (model_.pictures().Find(PictureKey(search_id, path))) return;
  asker_.Want({search_id, search->root().epoch, path}, urgent);
}

void BusSource::Tick() {
  if (supervised_due_.Due(SteadyMs())) ReadSupervised();
  if (SteadyMs() < stop_until_ms_) CancelAction();
  const std::lock_guard<std::mutex> lock(mutex());
  model_.Advance(UtimeNow());
  asker_.Turn(SteadyMs(), model_.Searching(), [this](const PictureAsker::Wish& wish) {
    return model_.pictures().Find(PictureKey(wish.search_id, wish.path)) != nullptr;
  });
}

void BusSource::ReadSupervised() {
  supervised_ = json::array();
  if (options_.services_file.empty()) return;
  std::ifstream in(options_.services_file);
  const json file = in ? json::parse(in, nullptr, false) : json();
  if (!file.is_object() || !file.contains("services") || !file["services"].is_array()) return;
  for (const json& service : file["services"]) {
    if (!service.is_object()) continue;
    supervised_.push_back({{"name", service.value("name", "")},
                           {"pid", service.value("pid", -1)},
                           {"state", service.value("state", "")},
                           {"restarts", service.value("restarts", 0)},
                           {"last_words", service.value("last_words", "")}});
  }
}

BusSource::May BusSource::WhatMay() {
  if (!options_.control) {
    const std::string looks = "this console only looks: start it with --control";
    return {looks, looks, looks};
  }
  const std::lock_guard<std::mutex> lock(mutex());
  const std::int64_t now_us = model_.now_us();
  May may;
  const bool busy = starter_.running() || model_.services().Alive("executive", now_us) > 0;
  if (busy) {
    may.run = "an episode runs";
  } else if (!model_.task()) {
    may.run = "no simulator and no robot is heard";
  } else if (model_.services().Alive("model", now_us) == 0) {
    may.run = "no model server is heard";
  } else if (model_.services().Alive("worker", now_us) == 0) {
    may.run = "no planner worker is heard";
  }
  if (!busy && !model_.episode().running()) may.stop = "nothing runs";
  if (options_.services_file.empty() || supervised_.empty())
    may.scale = "the deployment is not kept by a supervisor on this machine";
  return may;
}

json BusSource::Facts() {
  const May may = WhatMay();
  json facts = starter_.Facts();
  facts["kind"] = "bus";
  facts["bus"] = bus_.url();
  facts["control"] = options_.control;
  facts["failed"] = failed_.load();
  facts["may"] = {{"run", may.run}, {"stop", may.stop}, {"scale", may.scale}};
  facts["supervised"] = supervised_;
  return facts;
}

std::string BusSource::Do(const std::string& what, const json& request) {
  if (what == "judge") return Judge(request);
  const May may = WhatMay();
  // Whatever is known to run: a robot may have begun to move a moment ago.
  if (what == "stop") return options_.control ? Stop() : may.stop;
  if (what == "run") {
    if (!may.run.empty()) return may.run;
    std::string task;
    {
      const std::lock_guard<std::mutex> lock(mutex());
      task = model_.task()->name;
    }
    return starter_.Run(request, task);
  }
  if (what == "scale")
    return may.scale.empty() ? starter_.Scale(request.at("workers").get<int>()) : may.scale;
  return "a live bus cannot do that";
}

// Asks for V and f along a path, once its search is over: an evaluation that no worker asked for
// would count as a visit in one that runs.
std::string BusSource::Judge(const json& request) {
  const std::int64_t id = IdFrom(request.at("search"));
  const planner::Path path = PathFrom(request.at("path"));
  const std::lock_guard<std::mutex> lock(mutex());
  SearchView* search = model_.Find(id);
  if (!search) return "this search is not known any more";
  if (!search->stopped()) return "the search still runs: wait until it is over";
  for (std::size_t length = 1; length <= path.size(); ++length) {
    const planner::Path prefix(path.begin(), path.begin() + static_cast<std::ptrdiff_t>(length));
    if (!search->Legal(prefix)) {
      return NamesOf(search->task(), {prefix.back()}) + " may not come " +
             (length == 1 ? "first" : "after " + NamesOf(search->task(), {path[length - 2]}));
    }
  }
  expand_request_t ask{};
  for (std::size_t length = 0; length <= path.size(); ++length) {
    const planner::Path prefix(path.begin(), path.begin() + static_cast<std::ptrdiff_t>(length));
    if (!search->Evaluated(prefix)) ask.paths.push_back(ToMessage(prefix));
  }
  if (ask.paths.empty()) return "";
  ask.utime = UtimeNow();
  ask.client_id = client_id_;
  ask.request_id = ++request_id_;
  ask.server_id = model_.services().AnyServer(search->root().weights_hash, model_.now_us());
  ask.search_id = id;
  ask.epoch = search->root().epoch;
  ask.weights_hash = search->root().weights_hash;
  ask.budget_ms = -1;
  ask.num_paths = static_cast<std::int32_t>(ask.paths.size());
  bus_.Publish(ask);
  return "";
}

std::string BusSource::Stop() {
  stop_until_ms_ = SteadyMs() + kStopMs;
  CancelAction();
  starter_.Stop();
  StopExecutiveHere();
  return "";
}

// At once, as whoever holds the robot: nobody else is obeyed. Nothing where its status says that
// it was heard.
void BusSource::CancelAction() {
  action_command_t cancel{};
  {
    const std::lock_guard<std::mutex> lock(mutex());
    const auto& status = model_.episode().status();
    if (!status || status->holder_id == 0) return;
    if (status->executive_id == status->holder_id && status->command_id == kLastCommand) return;
    cancel.executive_id = status->holder_id;
    cancel.command_id = kLastCommand;
    cancel.episode_id = status->episode_id;
  }
  cancel.utime = UtimeNow();
  cancel.kind = action_command_t::KIND_CANCEL;
  cancel.action = -1;
  bus_.Publish(cancel);
}

// Once each: a second signal would end it before the robot stands still.
void BusSource::StopExecutiveHere() {
  std::vector<int> pids;
  {
    const std::lock_guard<std::mutex> lock(mutex());
    pids = model_.services().PidsOn(HostName(), "executive", model_.now_us());
  }
  for (const int pid : pids) {
    const bool ours = starter_.pid() > 0 && ParentOf(pid) == starter_.pid();
    if (!ours && IsExecutiveHere(pid) && signalled_.insert(pid).second) kill(pid, SIGTERM);
  }
}

}  // namespace prospect::services::console
