#include "services/binding/shared_search.h"

#include "base/number_format.h"
#include "services/binding/evaluation_messages.h"
#include "services/binding/search_messages.h"
#include "services/binding/statistics_messages.h"
#include "services/binding/task_messages.h"

namespace prospect::services {

SharedSearch::SharedSearch(const search_root_t& root, const planner::TaskRules& rules,
                           std::int64_t writer, int worker_index, std::int64_t now_us,
                           int listed_futures)
    : root_(root) {
  planner::SearchIdentity identity;
  identity.search = SearchIdFrom(root);
  identity.writer = static_cast<std::uint64_t>(writer);
  identity.worker_index = worker_index;
  identity.lease_us = kLeaseMs * 1000;
  auto parameters = ParametersFrom(root, now_us);
  parameters.listed_futures = listed_futures;
  search_ = std::make_unique<planner::Search>(rules, parameters, ExecutedFrom(root), identity);
}

void SharedSearch::Hear(const expand_reply_t& reply, const RequestWindow* only_awaited) {
  if (!Concerns(reply.search_id, reply.epoch)) return;
  if (root_.weights_hash != 0 && reply.weights_hash != root_.weights_hash) return;
  for (const auto& evaluation : reply.evaluations) {
    if (!sharing() && only_awaited && !only_awaited->Awaits(evaluation.path.actions)) continue;
    const auto delivery = search_->Deliver(FromMessage(evaluation.path),
                                           FromMessage(evaluation, search_->rules().num_actions),
                                           static_cast<std::uint64_t>(reply.fingerprint));
    if (delivery == planner::Delivery::kRefused) ++refused_evaluations_;
  }
}

void SharedSearch::Hear(const expand_request_t& request, std::int64_t client_id,
                        std::int64_t now_us) {
  if (!Concerns(request.search_id, request.epoch) || !sharing() || request.client_id == client_id)
    return;
  search_->NoteRequested(FromMessages(request.paths), now_us,
                         static_cast<std::uint64_t>(request.client_id));
}

void SharedSearch::Hear(const search_statistics_t& statistics, std::int64_t now_us) {
  if (!Concerns(statistics.search_id, statistics.epoch)) return;
  if (static_cast<std::uint64_t>(statistics.writer) == search_->statistics().writer()) return;
  search_->Merge(FromMessage(statistics), now_us);
}

std::string Summary(const planner::Plan& plan, const task_t& task) {
  if (!plan.ok()) return std::string(ToString(plan.status)) + ": " + plan.reason;
  return "plan " + NamesOf(task, plan.best.path) + "; score " + base::Fixed(plan.best.score, 6);
}

}  // namespace prospect::services
