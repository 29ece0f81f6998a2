#include "services/console/console_model.h"

#include <algorithm>

#include "lcmtypes/checked_codec.h"
#include "lcmtypes/validate.h"
#include "services/common/channels.h"

namespace prospect::services::console {
namespace {

using nlohmann::json;

// SEARCH_ROOT comes ten times a second while a search lasts.
constexpr std::int64_t kSearchSilentUs = 3'000'000;

// Calls `take` with the message if it is one of T. @return why it is none; empty: it is one, or is
// of another channel
template <class T, class Take>
std::string Try(const BusEvent& event, const Take& take) {
  if (event.channel != ChannelOf<T>()) return "";
  const auto result = messages::CheckedDecode<T>(event.bytes.data(), event.bytes.size());
  if (!result.ok()) return result.reason;
  const std::string reason = messages::Validate(result.value);
  if (reason.empty()) take(result.value);
  return reason;
}

json TaskJson(const task_t& task) {
  json actions = json::array(), causes = json::object(), initial = json::array();
  for (const auto& action : task.actions) {
    actions.push_back({{"name", action.name},
                       {"kind", action.kind},
                       {"object", action.object},
                       {"next", action.successors}});
  }
  for (const auto& cause : task.causes) causes[cause.name] = cause.words;
  for (const auto first : task.initial) initial.push_back(first);
  return {{"name", task.name},
          {"actions", actions},
          {"causes", causes},
          {"initial", initial},
          {"width", task.image_width},
          {"height", task.image_height},
          {"plan_length", task.plan_length},
          {"limit_s", task.action_time_limit}};
}

}  // namespace

// Half for searches and a quarter for pictures; the rest is the process itself, its viewers' data
// and what JSON takes while it is made.
ConsoleModel::ConsoleModel(std::size_t bytes, std::uint64_t generation)
    : generation_(generation), most_search_bytes_(bytes / 2), pictures_(bytes / 4) {}

std::uint64_t ConsoleModel::state_revision() const { return state_revision_ + episode_.revision(); }

void ConsoleModel::Take(const BusEvent& event) {
  if (event.channel == "LCM_SELF_TEST" || event.channel == "PROSPECT_SELF_TEST") return;
  ++revision_;
  Advance(event.utime);
  std::string refused = event.refused;
  if (refused.empty()) {
    newest_utime_ = event.utime;
    try {
      refused = Dispatch(event);
    } catch (const std::exception&) {
      refused = "not understood";  // a search that its workers refuse, too
    }
  }
  traffic_.Add(event.channel, event.bytes.size(), refused, event.utime);
}

std::string ConsoleModel::Dispatch(const BusEvent& event) {
  const std::int64_t now_us = event.utime;
  return Try<task_t>(event, [&](const task_t& task) { OnTask(task); }) +
         Try<observation_t>(event, [&](const observation_t& seen) { OnObservation(seen); }) +
         Try<action_status_t>(event, [&](const auto& status) { episode_.Hear(status); }) +
         Try<verdict_t>(event, [&](const auto& verdict) { episode_.Hear(verdict); }) +
         Try<plan_t>(event, [&](const plan_t& plan) { episode_.Hear(plan); }) +
         Try<health_t>(event, [&](const health_t& health) { OnHealth(health, now_us); }) +
         Try<model_info_t>(event, [&](const auto& info) { services_.Hear(info, now_us); }) +
         Try<predict_reply_t>(event, [&](const auto& reply) { OnPicture(reply); }) +
         DispatchSearch(event);
}

std::string ConsoleModel::DispatchSearch(const BusEvent& event) {
  const std::int64_t now_us = event.utime;
  return Try<search_root_t>(event, [&](const auto& root) { OnRoot(root, now_us); }) +
         Try<search_stop_t>(event, [&](const auto& stop) { OnStop(stop, now_us); }) +
         Try<expand_reply_t>(event,
                             [&](const expand_reply_t& reply) {
                               SearchView* search = Growing(reply.search_id);
                               if (search) search->Hear(reply);
                             }) +
         Try<search_statistics_t>(event, [&](const search_statistics_t& rows) {
           SearchView* search = Growing(rows.search_id);
           if (search) search->Hear(rows, now_us);
         });
}

// A search that may take more: one alone must not outgrow the memory either.
SearchView* ConsoleModel::Growing(std::int64_t search_id) {
  DropOldest();
  SearchView* search = Find(search_id);
  if (!search || search->bytes() < most_search_bytes_) return search;
  search->Cut();
  return nullptr;
}

void ConsoleModel::OnObservation(const observation_t& seen) {
  const std::uint64_t before = episode_.pictures();
  episode_.Hear(seen);
  if (episode_.pictures() == before) return;
  for (const Act& act : episode_.acts()) {
    if (!act.seen || act.surprise >= 0) continue;
    const std::string key = PictureKey(act.search_id, act.path);
    const PicturePtr known = pictures_.Find(key);
    if (known) episode_.TakePicture(key, *known);
  }
}

void ConsoleModel::OnHealth(const health_t& health, std::int64_t now_us) {
  services_.Hear(health, now_us);
  episode_.Hear(health);
}

void ConsoleModel::OnStop(const search_stop_t& stop, std::int64_t now_us) {
  SearchView* search = Find(stop.search_id);
  if (!search || search->root().epoch != stop.epoch || search->stopped()) return;
  search->NoteHeard(now_us);
  search->Stop(stop.reason);
  ++state_revision_;
}

void ConsoleModel::OnTask(const task_t& task) {
  if (task_ && task_->task_hash == task.task_hash) return;
  task_ = task;
  ++state_revision_;
}

void ConsoleModel::OnRoot(const search_root_t& root, std::int64_t now_us) {
  SearchView* known = Find(root.search_id);
  if (known && known->root().epoch >= root.epoch) return known->NoteHeard(now_us);
  if (!task_ || task_->task_hash != root.task_hash) return;
  if (known) {
    std::erase_if(searches_, [&](const auto& search) { return search.get() == known; });
  }
  searches_.push_back(std::make_unique<SearchView>(*task_, root, now_us));
  episode_.Hear(root, now_us);
  DropOldest();
  ++state_revision_;
}

void ConsoleModel::OnPicture(const predict_reply_t& reply) {
  if (reply.status != expand_reply_t::STATUS_OK || reply.width == 0) return;
  const std::string key = PictureKey(reply.search_id, reply.path.actions);
  Picture picture{reply.width, reply.height, reply.data};
  episode_.TakePicture(key, picture);
  pictures_.Put(key, std::move(picture));
}

std::size_t ConsoleModel::bytes() const {
  std::size_t bytes = pictures_.bytes();
  for (const auto& search : searches_) bytes += search->bytes();
  return bytes;
}

void ConsoleModel::DropOldest() {
  while (searches_.size() > 1 && bytes() - pictures_.bytes() > most_search_bytes_) {
    searches_.pop_front();
    ++dropped_searches_;
  }
}

SearchView* ConsoleModel::Find(std::int64_t search_id) {
  for (auto search = searches_.rbegin(); search != searches_.rend(); ++search)
    if ((*search)->root().search_id == search_id) return search->get();
  return nullptr;
}

SearchView* ConsoleModel::Latest() { return searches_.empty() ? nullptr : searches_.back().get(); }

bool ConsoleModel::Searching() const {
  return !searches_.empty() && !searches_.back()->stopped() &&
         now_us_ - searches_.back()->heard_us() < kSearchSilentUs;
}

std::string ConsoleModel::Happening() const {
  if (!task_) return "nobody";
  if (episode_.running()) return "acting";
  if (Searching()) return "thinking";
  if (!episode_.outcome().empty()) return episode_.outcome();
  return services_.Alive("executive", now_us_) > 0 ? "deciding" : "idle";
}

json ConsoleModel::State() {
  json list = json::array();
  for (const auto& search : searches_) {
    list.push_back({{"id", std::to_string(search->root().search_id)},
                    {"episode", std::to_string(search->root().episode_id)},
                    {"executed", search->root().num_executed},
                    {"nodes", search->nodes()},
                    {"running", !search->stopped()}});
  }
  return {{"task", task_ ? TaskJson(*task_) : json()},
          {"episode", episode_.ToJson()},
          {"happening", Happening()},
          {"searches", list},
          {"dropped_searches", dropped_searches_},
          {"dropped_pictures", pictures_.dropped()}};
}

json ConsoleModel::Bus() {
  json bus = services_.ToJson(now_us_);
  bus["channels"] = traffic_.ToJson(now_us_);
  bus["workers"] = services_.Alive("worker", now_us_);
  bus["memory_mb"] = static_cast<double>(bytes() >> 10) / 1024;
  return bus;
}

}  // namespace prospect::services::console
