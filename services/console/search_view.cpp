#include "services/console/search_view.h"

#include <algorithm>
#include <cmath>

#include "services/binding/evaluation_messages.h"
#include "services/binding/statistics_messages.h"
#include "services/binding/task_messages.h"

namespace prospect::services::console {
namespace {

using nlohmann::json;
using planner::PathId;

constexpr std::int64_t kObserver = 1;  // a writer id that no worker has
constexpr int kListedFutures = 64;
constexpr std::int64_t kPlanUs = 200'000;
// What planner::Search, ChangeOrder and Shown hold a node, besides Q, p and child slots (measured).
constexpr std::size_t kBytesPerNode = 320, kBytesPerNodeAction = 12;

json Ids(const planner::Path& path) {
  json ids = json::array();
  for (const auto action : path) ids.push_back(action);
  return ids;
}

}  // namespace

std::string PathText(const planner::Path& path) {
  return path.empty() ? "" : planner::ToString(path);
}

double Short(double number) { return std::isfinite(number) ? std::round(number * 1e4) / 1e4 : 0; }

SearchView::SearchView(const task_t& task, const search_root_t& root, std::int64_t now_us)
    : task_(task),
      shared_(root, RulesOfSearch(task, root), kObserver, 0, now_us, kListedFutures),
      begun_us_(now_us),
      heard_us_(now_us) {
  Touch(planner::kRoot, -1);
}

int SearchView::ServerIndex(std::int64_t server_id) {
  const auto found = std::find(servers_.begin(), servers_.end(), server_id);
  if (found != servers_.end()) return static_cast<int>(found - servers_.begin());
  servers_.push_back(server_id);
  return static_cast<int>(servers_.size()) - 1;
}

void SearchView::Touch(PathId id, int server) {
  if (id == planner::kNoPath) return;
  if (static_cast<std::size_t>(id) >= shown_.size())
    shown_.resize(static_cast<std::size_t>(id) + 1);
  const auto& totals = shared_.search().statistics().totals(id);
  Shown& shown = shown_[id];
  const bool same = shown.visits == totals.visits && shown.value_sum == totals.value_sum &&
                    shown.best == totals.best;
  if (same && server < 0) return;
  shown = {totals.visits, totals.value_sum, totals.best,
           server >= 0 ? static_cast<std::int16_t>(server) : shown.server};
  changes_.Touch(id);
  ++revision_;
}

bool SearchView::Hear(const expand_reply_t& reply) {
  if (!shared_.Concerns(reply.search_id, reply.epoch)) return false;
  const std::int64_t known = shared_.search().known_evaluations();
  shared_.Hear(reply);
  const bool news = shared_.search().known_evaluations() != known;
  const int server = news ? ServerIndex(reply.server_id) : -1;
  for (const auto& evaluation : reply.evaluations) {
    const PathId id = shared_.search().paths().Find(FromMessage(evaluation.path));
    if (news && id != planner::kNoPath && shared_.search().evaluation_table().Has(id))
      Touch(id, server);
  }
  return true;
}

bool SearchView::Hear(const search_statistics_t& statistics, std::int64_t now_us) {
  if (!shared_.Concerns(statistics.search_id, statistics.epoch)) return false;
  const planner::StatisticsBatch batch = FromMessage(statistics);
  shared_.search().Merge(batch, now_us);
  for (const auto& row : batch.rows) Touch(shared_.search().paths().Find(row.path), -1);
  return true;
}

void SearchView::Stop(const std::string& reason) {
  if (stopped_) return;
  stopped_ = true;
  stop_reason_ = reason;
  ended_us_ = heard_us_;
  ++revision_;
}

void SearchView::Cut() {
  if (!cut_) ++revision_;
  cut_ = true;
}

std::size_t SearchView::bytes() const {
  const auto actions = static_cast<std::size_t>(task_.num_actions);
  return static_cast<std::size_t>(nodes()) * (kBytesPerNode + kBytesPerNodeAction * actions) +
         64 * static_cast<std::size_t>(plan_.rejected.size() + plan_.runners_up.size());
}

bool SearchView::Legal(const planner::Path& path) const {
  return shared_.search().rules().Legal(shared_.search().executed(), path);
}

bool SearchView::Evaluated(const planner::Path& path) const {
  const PathId id = Find(path);
  return id != planner::kNoPath && shared_.search().evaluation_table().Has(id);
}

double SearchView::ScoreOf(PathId id) const {
  const auto& table = shared_.search().evaluation_table();
  const auto& paths = shared_.search().paths();
  if (!table.Has(id)) return 0;
  double score = table.value(id);
  for (PathId at = id; at != planner::kRoot; at = paths.parent(at)) {
    if (!table.Has(at)) return 0;
    score *= table.done(at);
  }
  return score;
}

// Why a future was followed no further here.
const char* SearchView::MarkOf(PathId id) const {
  const auto& search = shared_.search();
  if (id == planner::kRoot || !search.evaluation_table().Has(id)) return "";
  if (search.evaluation_table().done(id) < search.parameters().c_done) return "f";
  if (search.evaluation_table().value(id) < search.parameters().v_failed) return "V";
  return search.rules().Complete(search.executed(), PathOf(id)) ? "end" : "";
}

json SearchView::Row(PathId id) const {
  const auto& search = shared_.search();
  const auto& table = search.evaluation_table();
  const PathId parent = search.paths().parent(id);
  const int action = search.paths().action(id);
  const auto& totals = search.statistics().totals(id);
  const bool known = table.Has(id), judged = parent >= 0 && table.Has(parent);
  return json::array({id, parent, action, totals.visits, Short(totals.mean()), Short(totals.best),
                      known ? json(Short(table.value(id))) : json(),
                      known ? json(Short(table.done(id))) : json(),
                      judged ? json(Short(table.q(parent)[action])) : json(),
                      judged ? json(Short(table.p(parent)[action])) : json(),
                      known ? json(Short(ScoreOf(id))) : json(), MarkOf(id), shown_[id].server});
}

json SearchView::Rows(std::uint64_t* since, std::size_t most) const {
  json rows = json::array();
  for (const int id : changes_.After(since, most)) rows.push_back(Row(id));
  return rows;
}

void SearchView::ReadPlan(std::int64_t now_us) {
  const bool fresh = plan_change_ == changes_.latest() && plan_after_stop_ == stopped_;
  const bool early = !stopped_ && plan_us_ > 0 && std::abs(now_us - plan_us_) < kPlanUs;
  if (fresh || early) return;
  plan_ = shared_.search().BestPlan();
  plan_change_ = changes_.latest();
  plan_us_ = now_us;
  plan_after_stop_ = stopped_;
}

json SearchView::FutureJson(const planner::Future& future) const {
  json steps = json::array();
  for (const auto& step : future.steps) {
    steps.push_back({{"action", step.action},
                     {"V", Short(step.value)},
                     {"f", Short(step.done)},
                     {"p", Short(step.prior)},
                     {"Q", Short(step.q)},
                     {"score", Short(step.score)},
                     {"N", step.visits}});
  }
  return {
      {"path", Ids(future.path)},
      {"steps", steps},
      {"score", Short(future.score)},
      {"complete", future.complete},
      {"N", future.visits},
      {"why",
       future.rejection == planner::Rejection::kNone ? "" : planner::ToString(future.rejection)}};
}

json SearchView::Meta(std::int64_t now_us) {
  ReadPlan(now_us);
  const auto& root = shared_.root();
  const auto& search = shared_.search();
  json misses = json::array(), others = json::array(), goals = json::array(),
       servers = json::array();
  for (const auto& future : plan_.rejected) {
    if (misses.size() < 12) misses.push_back(FutureJson(future));
  }
  for (const auto& future : plan_.runners_up) {
    if (others.size() < 8) others.push_back(FutureJson(future));
  }
  for (const auto& goal : root.goals) goals.push_back(goal.substr(0, goal.find('=')));
  for (const auto id : servers_) servers.push_back(std::to_string(id));
  return {{"id", std::to_string(root.search_id)},
          {"epoch", root.epoch},
          {"episode", std::to_string(root.episode_id)},
          {"executed", Ids(root.executed)},
          {"goals", goals},
          {"plan_length", root.plan_length},
          {"rule", root.rule},
          {"samples", root.samples},
          {"limits",
           {{"p", search.parameters().p_min},
            {"f", search.parameters().c_done},
            {"V", search.parameters().v_failed},
            {"score", search.parameters().refusal_threshold}}},
          {"begun_us", begun_us_},
          {"seconds",
           Short(1e-6 * static_cast<double>((stopped_ ? ended_us_ : heard_us_) - begun_us_))},
          {"running", !stopped_},
          {"ended", stop_reason_},
          {"rollouts", search.total_rollouts()},
          {"evaluations", search.known_evaluations()},
          {"nodes", nodes()},
          {"cut", cut_},
          {"servers", servers},
          {"status", planner::ToString(plan_.status)},
          {"reason", plan_.reason},
          {"root_value", Short(plan_.root_value)},
          {"best", FutureJson(plan_.best)},
          {"others", others},
          {"misses", misses},
          {"tally",
           {{"complete", plan_.complete_futures},
            {"p", plan_.not_permitted},
            {"f", plan_.not_done},
            {"V", plan_.low_value},
            {"score", plan_.low_score},
            {"untried", plan_.untried}}}};
}

json SearchView::Choices(int node) const {
  const auto& search = shared_.search();
  json rows = json::array();
  if (node < 0 || node >= nodes() || !search.evaluation_table().Has(node)) return rows;
  for (const int action : search.rules().AllowedActions(search.executed(), PathOf(node))) {
    rows.push_back({{"action", action},
                    {"Q", Short(search.evaluation_table().q(node)[action])},
                    {"p", Short(search.evaluation_table().p(node)[action])},
                    {"node", search.paths().Find(node, action)}});
  }
  return rows;
}

}  // namespace prospect::services::console
