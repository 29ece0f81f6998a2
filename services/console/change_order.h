#pragma once

#include <cstdint>
#include <vector>

namespace prospect::services::console {

/// Which of numbered things changed when, so that each viewer can be told what changed since it was
/// last told, however long ago that was, and nothing need be kept for it meanwhile. Noting a change
/// is O(1), listing is O(changes since). One thread at a time.
class ChangeOrder {
 public:
  /// Thing `id` (0 or more) has changed: it is the latest now.
  void Touch(int id);

  /// Number of the latest change; 0: there was none.
  std::uint64_t latest() const { return latest_; }

  /// Things that changed after change number `*since`, each once, the oldest change first, at most
  /// `most`; moves `*since` to the change of the last one listed.
  std::vector<int> After(std::uint64_t* since, std::size_t most) const;

  std::size_t size() const { return links_.size(); }

 private:
  struct Link {
    int before = -1, after = -1;
    std::uint64_t change = 0;  ///< 0: never
  };

  void Unlink(int id);

  std::vector<Link> links_;
  int newest_ = -1;
  std::uint64_t latest_ = 0;
};

}  // namespace prospect::services::console
