#include "services/console/picture_store.h"

#include <utility>

#include "planner/path.h"

namespace prospect::services::console {

void PictureStore::Put(const std::string& key, Picture picture) {
  const auto known = index_.find(key);
  if (known != index_.end()) {
    bytes_ -= known->second->picture->rgb.size();
    entries_.erase(known->second);
    index_.erase(known);
  }
  bytes_ += picture.rgb.size();
  entries_.push_front({key, std::make_shared<const Picture>(std::move(picture))});
  index_[key] = entries_.begin();
  while (bytes_ > most_bytes_ && entries_.size() > 1) {
    bytes_ -= entries_.back().picture->rgb.size();
    index_.erase(entries_.back().key);
    entries_.pop_back();
    ++dropped_;
  }
}

PicturePtr PictureStore::Find(const std::string& key) {
  const auto found = index_.find(key);
  if (found == index_.end()) return nullptr;
  entries_.splice(entries_.begin(), entries_, found->second);
  return found->second->picture;
}

std::string PictureKey(std::int64_t search_id, const std::vector<std::uint8_t>& path) {
  return std::to_string(search_id) + "/" + (path.empty() ? "" : planner::ToString(path));
}

}  // namespace prospect::services::console
