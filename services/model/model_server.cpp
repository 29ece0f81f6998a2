#include "services/model/model_server.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <unordered_set>

#include "services/binding/calibration_messages.h"
#include "services/binding/evaluation_messages.h"
#include "services/binding/novelty_messages.h"
#include "services/binding/search_messages.h"
#include "services/binding/task_messages.h"

namespace prospect::services {
namespace {

constexpr std::size_t kMostSearches = 4;
constexpr std::size_t kMostPredictions = 256;
constexpr std::size_t kRememberedStops = 256;
constexpr std::int64_t kRootSilenceMs = 2000;
constexpr int kLongestWaitMs = 100;
constexpr int kNotReadyRetryMs = 20;
// Polls before a batch: takes what has arrived, without letting a flood keep the server from its
// work.
constexpr int kMostPolls = 4;
// Keeps a reply within one datagram (65,499 bytes) with room for the largest evaluation.
constexpr std::size_t kReplyBytes = 56000;

using planner::Path;

std::size_t ReplyBytes(const evaluation_t& evaluation) {
  return 20 + evaluation.path.actions.size() + 5 * evaluation.actions.size();
}

}  // namespace

ModelServer::ModelServer(Bus& bus, model::Engine& engine, const ModelServerOptions& options)
    : bus_(bus),
      engine_(engine),
      options_(options),
      health_(bus, "model"),
      encoder_(engine),
      queue_(options.queue_paths),
      statistics_(options.batch) {
  subscriptions_.push_back(bus_.Subscribe<task_t>([this](const task_t& task) { task_ = task; }));
  subscriptions_.push_back(
      bus_.Subscribe<search_root_t>([this](const search_root_t& root) { OnRoot(root); }));
  subscriptions_.push_back(
      bus_.Subscribe<search_image_t>([this](const search_image_t& image) { OnImage(image); }));
  subscriptions_.push_back(
      bus_.Subscribe<search_stop_t>([this](const search_stop_t& stop) { OnStop(stop); }));
  subscriptions_.push_back(bus_.Subscribe<expand_request_t>(
      [this](const expand_request_t& request) { OnExpand(request); }));
  subscriptions_.push_back(bus_.Subscribe<predict_request_t>(
      [this](const predict_request_t& request) { OnPredict(request); }));
  health_.SetState(health_t::STATE_READY);
}

ModelServer::Active* ModelServer::Find(std::int64_t search_id, std::int32_t epoch) {
  for (auto& active : searches_) {
    if (active.root.search_id == search_id && active.root.epoch == epoch) return &active;
  }
  return nullptr;
}

bool ModelServer::Suits(const search_root_t& root) const {
  const auto& info = engine_.info();
  if (root.weights_hash != 0 &&
      root.weights_hash != static_cast<std::int64_t>(engine_.weights_hash()))
    return false;
  if (!task_ || task_->task_hash != root.task_hash) return false;
  return task_->name == info.task && task_->num_actions == info.num_actions;
}

void ModelServer::OnRoot(const search_root_t& root) {
  if (stopped_searches_.contains(root.search_id) || !Suits(root)) return;
  if (Active* active = Find(root.search_id, root.epoch)) {
    active->heard_ms = SteadyMs();
    return;
  }
  const bool stale = std::any_of(searches_.begin(), searches_.end(), [&](const Active& other) {
    return other.root.search_id == root.search_id && other.root.epoch > root.epoch;
  });
  if (!stale) Admit(root);
}

void ModelServer::Admit(const search_root_t& root) {
  queue_.Cancel(root.search_id, root.epoch);
  searches_.remove_if([&](const Active& other) { return other.root.search_id == root.search_id; });
  Active active;
  active.root = root;
  active.heard_ms = SteadyMs();
  planner::TaskRules rules = RulesFromTask(*task_);
  rules.plan_length = root.plan_length;
  active.memory = std::make_unique<SearchMemory>(engine_, std::move(rules), ExecutedFrom(root),
                                                 options_.cache_bytes);
  searches_.push_front(std::move(active));
  if (searches_.size() > kMostSearches) searches_.pop_back();
  spdlog::debug("search {} epoch {} begins", root.search_id, root.epoch);
}

void ModelServer::OnImage(const search_image_t& image) {
  const auto found = std::find_if(searches_.begin(), searches_.end(), [&](const Active& a) {
    return a.root.search_id == image.search_id;
  });
  if (found == searches_.end() || found->memory->ready()) return;
  const auto& info = engine_.info();
  if (image.width != info.image_width || image.height != info.image_height) {
    bus_.CountRefused(ChannelOf<search_image_t>(), "image size");
    return;
  }
  found->pictures[image.image_id] = encoder_.Encode(image.data);
  if (image.image_id == found->root.image_id) found->present_picture = image.data;
  const auto first = found->pictures.find(found->root.image0_id);
  const auto present = found->pictures.find(found->root.image_id);
  if (first == found->pictures.end() || present == found->pictures.end()) return;
  found->memory->SetRoot(first->second, present->second);
  found->pictures.clear();
  PublishInfo(&*found);
}

void ModelServer::OnStop(const search_stop_t& stop) {
  if (stopped_searches_.size() >= kRememberedStops) stopped_searches_.clear();
  if (!stopped_searches_.insert(stop.search_id).second) return;
  queue_.Cancel(stop.search_id, stop.epoch + 1);
  if (const Active* active = Find(stop.search_id, stop.epoch)) PublishInfo(active);
}

// Empty when the request may wait for its turn.
std::string ModelServer::Defect(const expand_request_t& request, Active* active) const {
  if (!engine_.info().judges) return model::kPicturesOnly;
  if (request.weights_hash != 0 &&
      request.weights_hash != static_cast<std::int64_t>(engine_.weights_hash())) {
    return "other weights are loaded";
  }
  for (const auto& path : request.paths) {
    if (!active->memory->Legal(path.actions))
      return "path " + planner::ToString(path.actions) + " is against the rules";
  }
  return "";
}

void ModelServer::OnExpand(const expand_request_t& request) {
  if (request.server_id != 0 && request.server_id != health_.instance_id()) return;
  Active* active = Find(request.search_id, request.epoch);
  if (!active || !active->memory->ready()) {
    return Refuse(request, expand_reply_t::STATUS_REFUSED, kNotReadyRetryMs,
                  "search not encoded yet");
  }
  const std::string defect = Defect(request, active);
  if (!defect.empty()) {
    bus_.CountRefused(ChannelOf<expand_request_t>(), "rules");
    return Refuse(request, expand_reply_t::STATUS_REFUSED, 0, defect);
  }
  const std::int64_t now_us = SteadyUs();
  timing_.NoteRequest(request.client_id, now_us);
  if (!queue_.Put(request, now_us))
    Refuse(request, expand_reply_t::STATUS_BUSY, RetryMs(), "queue full");
}

double ModelServer::WaitMs() const {
  const auto batches = static_cast<double>(queue_.paths()) / options_.batch;
  return batches * statistics_.batch_ms();
}

int ModelServer::RetryMs() const { return std::clamp(static_cast<int>(WaitMs()), 10, 2000); }

expand_reply_t ModelServer::ReplyHead(const search_root_t& root) const {
  expand_reply_t reply{};
  reply.utime = UtimeNow();
  reply.server_id = health_.instance_id();
  reply.search_id = root.search_id;
  reply.epoch = root.epoch;
  reply.weights_hash = static_cast<std::int64_t>(engine_.weights_hash());
  reply.fingerprint = static_cast<std::int64_t>(engine_.fingerprint());
  reply.status = expand_reply_t::STATUS_OK;
  return reply;
}

void ModelServer::Refuse(const expand_request_t& request, std::int8_t status, int retry_ms,
                         const std::string& reason) {
  search_root_t root{};
  root.search_id = request.search_id;
  root.epoch = request.epoch;
  expand_reply_t reply = ReplyHead(root);
  reply.status = status;
  reply.retry_ms = retry_ms;
  reply.reason = reason;
  reply.client_ids = {request.client_id};
  reply.request_ids = {request.request_id};
  reply.num_requests = 1;
  bus_.Publish(reply);
}

// Paths of the head's search that nobody has evaluated yet, in order of arrival, at most a batch of
// them; paths known already are hits.
std::vector<Path> ModelServer::GatherPaths(const RequestQueue::Entry& head,
                                           std::vector<double>* ages_ms) {
  const Active* active = Find(head.search_id, head.epoch);
  std::vector<Path> paths;
  std::unordered_set<Path, planner::PathHash> seen;
  const std::int64_t now_us = SteadyUs();
  for (const auto& entry : queue_.entries()) {
    if (entry.search_id != head.search_id || entry.epoch != head.epoch) continue;
    for (const auto& path : entry.paths) {
      if (static_cast<int>(paths.size()) >= options_.batch) break;
      if (active->memory->Knows(path) || !seen.insert(path).second) continue;
      paths.push_back(path);
      ages_ms->push_back(1e-3 * static_cast<double>(now_us - entry.arrived_us));
    }
  }
  return paths;
}

void ModelServer::RunBatch() {
  queue_.Expire(SteadyUs());
  if (queue_.empty()) return;
  const RequestQueue::Entry head = queue_.entries().front();
  Active* active = Find(head.search_id, head.epoch);
  if (!active) return queue_.Cancel(head.search_id, head.epoch + 1);
  std::vector<double> ages_ms;
  const auto paths = GatherPaths(head, &ages_ms);
  const auto begun = std::chrono::steady_clock::now();
  const int rows = active->memory->Compute(paths, options_.batch);
  const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begun;
  statistics_.NoteBatch(rows, took.count(), ages_ms);
  timing_.NoteBatch(rows, 1000 * took.count());
  ReplyTo(*active, paths);
}

// One message for the batch: answers in full every request of this search whose paths are all known
// by now.
void ModelServer::ReplyTo(Active& active, const std::vector<Path>& computed) {
  expand_reply_t reply = ReplyHead(active.root);
  std::unordered_set<Path, planner::PathHash> told;
  std::size_t bytes = 0;
  const auto tell = [&](const Path& path) {
    if (!told.insert(path).second) return false;
    reply.evaluations.push_back(active.memory->Evaluation(path));
    bytes += ReplyBytes(reply.evaluations.back());
    return true;
  };
  for (const auto& path : computed) tell(path);
  std::int64_t hits = 0;
  const std::int64_t now_us = SteadyUs();
  auto& entries = queue_.entries();
  for (auto entry = entries.begin(); entry != entries.end();) {
    const bool whole = entry->search_id == active.root.search_id &&
                       entry->epoch == active.root.epoch && bytes < kReplyBytes &&
                       std::all_of(entry->paths.begin(), entry->paths.end(),
                                   [&](const Path& path) { return active.memory->Knows(path); });
    if (!whole) {
      ++entry;
      continue;
    }
    for (const auto& path : entry->paths) hits += tell(path) ? 1 : 0;
    statistics_.NoteAnswer(1e-3 * static_cast<double>(now_us - entry->arrived_us));
    reply.client_ids.push_back(entry->client_id);
    reply.request_ids.push_back(entry->request_id);
    entry = entries.erase(entry);
  }
  queue_.Recount();
  statistics_.NoteHits(hits);
  reply.num_requests = static_cast<std::int32_t>(reply.client_ids.size());
  reply.num_evaluations = static_cast<std::int32_t>(reply.evaluations.size());
  reply.wait_ms = WaitMs();
  bus_.Publish(reply);
  timing_.NoteAnswered(reply.client_ids, SteadyUs());
}

void ModelServer::OnPredict(const predict_request_t& request) {
  if (request.server_id != 0 && request.server_id != health_.instance_id()) return;
  const bool waits =
      std::any_of(predictions_.begin(), predictions_.end(), [&](const predict_request_t& other) {
        return other.client_id == request.client_id && other.request_id == request.request_id;
      });
  if (!waits && predictions_.size() < kMostPredictions) predictions_.push_back(request);
}

// What the networks make of the picture itself, and how unlike the known ones it is: whoever asks
// has seen it.
void ModelServer::AddRoot(const Active& active, const model::Hidden& state,
                          predict_reply_t* reply) {
  const auto& info = engine_.info();
  reply->data = engine_.Decode({state}).at(0);
  if (!options_.novelty) return;
  reply->novelty.push_back(ToMessage(options_.novelty->Judge(
      model::CompareRedrawn(active.present_picture, reply->data, info.image_width,
                            info.image_height, model::Unturned(state, info)))));
}

predict_reply_t ModelServer::Predict(const predict_request_t& request, Active* active) {
  predict_reply_t reply{};
  reply.server_id = health_.instance_id();
  reply.client_id = request.client_id;
  reply.request_id = request.request_id;
  reply.search_id = request.search_id;
  reply.epoch = request.epoch;
  reply.path = request.path;
  reply.status = expand_reply_t::STATUS_REFUSED;
  if (!active || !active->memory->ready()) {
    reply.reason = "this search is not held here";
  } else if (!active->memory->Legal(request.path.actions)) {
    reply.reason = "path against the rules";
  } else {
    reply.status = expand_reply_t::STATUS_OK;
    const model::Hidden state = active->memory->State(request.path.actions);
    if (request.path.actions.empty()) {
      AddRoot(*active, state, &reply);
      if (!request.want_image) reply.data.clear();
    } else if (request.want_image) {
      reply.data =
          engine_.DecodeOnto(active->present_picture, active->memory->State({}), {state}).at(0);
    }
    if (!reply.data.empty()) {
      reply.width = engine_.info().image_width;
      reply.height = engine_.info().image_height;
    }
    if (request.want_hidden) reply.hidden = state;
  }
  reply.num_bytes = static_cast<std::int32_t>(reply.data.size());
  reply.num_hidden = static_cast<std::int32_t>(reply.hidden.size());
  reply.num_novelty = static_cast<std::int32_t>(reply.novelty.size());
  return reply;
}

// One a turn: pictures are for people, and must not hold up a search.
void ModelServer::RunPrediction() {
  if (predictions_.empty()) return;
  const predict_request_t request = predictions_.front();
  predictions_.pop_front();
  predict_reply_t reply = Predict(request, Find(request.search_id, request.epoch));
  reply.utime = UtimeNow();
  bus_.Publish(reply);
}

// One message a search that is alive, the newest last, so that its name is the one that stays.
void ModelServer::PublishInfo() {
  bool said = false;
  for (auto active = searches_.rbegin(); active != searches_.rend(); ++active) {
    const bool alive = SteadyMs() - active->heard_ms < kRootSilenceMs;
    if (!alive || !active->memory->ready()) continue;
    PublishInfo(&*active);
    said = true;
  }
  if (!said) PublishInfo(nullptr);
}

void ModelServer::PublishInfo(const Active* active) {
  const auto& engine = engine_.info();
  model_info_t info{};
  info.utime = UtimeNow();
  info.server_id = health_.instance_id();
  info.engine = engine.engine;
  info.task = engine.task;
  info.weights_hash = static_cast<std::int64_t>(engine_.weights_hash());
  info.fingerprint = static_cast<std::int64_t>(engine_.fingerprint());
  info.num_actions = engine.num_actions;
  info.image_width = engine.image_width;
  info.image_height = engine.image_height;
  info.judges = engine.judges ? 1 : 0;
  info.refusal_threshold = engine.refusal_threshold;
  info.calibrations = static_cast<std::int32_t>(engine.calibrations.size());
  info.search_id = active ? active->root.search_id : 0;
  info.epoch = active ? active->root.epoch : 0;
  info.queue = static_cast<std::int32_t>(queue_.paths());
  statistics_.Fill(&info);
  bus_.Publish(info);
}

// Before MODEL_INFO: whoever has heard that of a server need not wait for these.
void ModelServer::PublishCalibrations() {
  const auto& engine = engine_.info();
  for (const model::CalibrationSample& sample : engine.calibrations) {
    calibration_t calibration{};
    calibration.utime = UtimeNow();
    calibration.server_id = health_.instance_id();
    calibration.weights_hash = static_cast<std::int64_t>(engine_.weights_hash());
    calibration.task = engine.task;
    SetSample(sample, &calibration);
    bus_.Publish(calibration);
  }
}

// How long the batch at hand waits for clients that are due back; 0 when it is full.
std::int64_t ModelServer::BatchWaitUs() {
  return static_cast<int>(queue_.paths()) >= options_.batch ? 0 : timing_.WaitUs(SteadyUs());
}

// Work that is there is begun unless clients are due back, for whom a poll waits: it returns with
// each message, and the question is put anew.
void ModelServer::Turn() {
  const bool idle = queue_.empty() && predictions_.empty();
  const auto wait =
      idle ? std::min<std::int64_t>(kLongestWaitMs, info_due_.Remaining(SteadyMs())) : 0;
  int polls = 0;
  for (int heard = bus_.Poll(static_cast<int>(wait)); heard > 0 && ++polls < kMostPolls;)
    heard = bus_.Poll(0);
  while (!queue_.empty() && BatchWaitUs() > 0) bus_.Poll(1);
  if (!queue_.empty()) RunBatch();
  if (queue_.empty()) RunPrediction();
  if (info_due_.Due(SteadyMs())) {
    PublishCalibrations();
    PublishInfo();
  }
  health_.SetQueue(static_cast<std::int32_t>(queue_.paths()));
  health_.SetCounter("evaluations", statistics_.evaluations());
  health_.SetCounter("cache hits", statistics_.hits());
  health_.Tick();
}

void ModelServer::Leave() {
  health_.SetState(health_t::STATE_DRAINING, "leaving");
  health_.PublishNow();
}

}  // namespace prospect::services
