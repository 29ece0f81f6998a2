#pragma once

#include <cstdint>
#include <list>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

namespace prospect::services::console {

/// A picture as it travels: rows from the top, three bytes R, G, B a pixel.
struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;

  bool empty() const { return rgb.empty(); }
};

using PicturePtr = std::shared_ptr<const Picture>;

/// Imagined pictures by search and path, the least recently used ones dropped beyond a number of
/// bytes. What was handed out lives on. One thread at a time.
class PictureStore {
 public:
  explicit PictureStore(std::size_t most_bytes) : most_bytes_(most_bytes) {}

  void Put(const std::string& key, Picture picture);
  /// Null: not here (any more).
  PicturePtr Find(const std::string& key);

  std::size_t bytes() const { return bytes_; }
  std::int64_t dropped() const { return dropped_; }

 private:
  struct Entry {
    std::string key;
    PicturePtr picture;
  };

  std::size_t most_bytes_, bytes_ = 0;
  std::int64_t dropped_ = 0;
  std::list<Entry> entries_;  // most recently used first
  std::unordered_map<std::string, std::list<Entry>::iterator> index_;
};

/// "SEARCH/PATH" of an imagined picture.
std::string PictureKey(std::int64_t search_id, const std::vector<std::uint8_t>& path);

}  // namespace prospect::services::console
