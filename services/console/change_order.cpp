#include "services/console/change_order.h"

namespace prospect::services::console {

void ChangeOrder::Unlink(int id) {
  const Link link = links_[id];
  if (link.before >= 0) links_[link.before].after = link.after;
  if (link.after >= 0) links_[link.after].before = link.before;
  if (newest_ == id) newest_ = link.before;
}

void ChangeOrder::Touch(int id) {
  if (static_cast<std::size_t>(id) >= links_.size())
    links_.resize(static_cast<std::size_t>(id) + 1);
  if (links_[id].change > 0) Unlink(id);
  links_[id] = {newest_, -1, ++latest_};
  if (newest_ >= 0) links_[newest_].after = id;
  newest_ = id;
}

std::vector<int> ChangeOrder::After(std::uint64_t* since, std::size_t most) const {
  int id = newest_;
  if (id < 0 || links_[id].change <= *since) return {};
  while (links_[id].before >= 0 && links_[links_[id].before].change > *since)
    id = links_[id].before;
  std::vector<int> found;
  for (; id >= 0 && found.size() < most; id = links_[id].after) {
    found.push_back(id);
    *since = links_[id].change;
  }
  return found;
}

}  // namespace prospect::services::console
