#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "model/trial.h"

namespace prospect::model::robomimic {

/// Demonstrations of others: an HDF5 file in robomimic's layout, of which only pictures and masks
/// are read. Holds the file open. Not thread-safe, and libhdf5 is used by one thread of a process
/// at a time.
class DemoFile {
 public:
  /// @param camera name of the pictures ("agentview_image"); empty: the only ones there are. Throws
  /// DataError (model/dataset.h), with the cameras that there are where `camera` is none.
  DemoFile(const std::string& path, const std::string& camera);
  ~DemoFile();
  DemoFile(const DemoFile&) = delete;
  DemoFile& operator=(const DemoFile&) = delete;

  const std::vector<std::string>& demos() const;  ///< "demo_0", ..., by their numbers
  const std::string& camera() const;
  /// Which part the masks train, valid and test put it in; nothing: none.
  std::optional<Split> part(const std::string& demo) const;

  /// A demonstration's pictures: `frames` of width x height x 3 bytes RGB.
  struct Size {
    int frames = 0, width = 0, height = 0;
  };
  /// Throws DataError where it has no pictures of the camera, or no RGB ones of a byte a channel.
  Size SizeOf(const std::string& demo) const;
  /// One picture of it, 0..frames-1. Throws DataError.
  void Read(const std::string& demo, int frame, std::vector<std::uint8_t>* rgb) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace prospect::model::robomimic
