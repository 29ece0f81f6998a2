#pragma once

#include <hdf5.h>

#include <cstdint>
#include <map>
#include <string>

#include "model/hdf5_io.h"
#include "model/trial.h"

/// How one trial and the masks lie in a data set (model/dataset.h describes the layout). For the
/// readers and writers of this room. `file` names the file in messages.
namespace prospect::model {

inline constexpr const char* kImageName = "agentview_image";
inline constexpr const char* kLandmarksName = "landmarks";

std::string DemoName(std::uint64_t seed);

/// All of a trial but its images.
void WriteDemoLabels(hid_t demo, const Trial& trial, const std::string& file);
/// The data set of images in `group` ("obs"), which is made; `frames` of them now and at most
/// `most` (H5S_UNLIMITED: any number).
hdf5::Handle CreateImages(hid_t demo, const char* group, const Trial& shape, hsize_t frames,
                          hsize_t most, const std::string& file);
/// A trial with its images as a group of `data`.
void WriteDemo(hid_t data, const Trial& trial, const std::string& file);
/// What holds for all trials of a file.
void WriteDataAttributes(hid_t data, const Trial& sample, std::int64_t frames,
                         const std::string& file);

/// The part of each trial, by seed.
using Parts = std::map<std::uint64_t, Split>;
void WriteMasks(hid_t root, const Parts& parts, const std::string& file);
/// What the masks of a file say; nothing where it has none. Throws DataError on a trial that is in
/// two of them.
Parts ReadMasks(hid_t root, const std::string& file);

/// The seed in "demo_SEED". Throws DataError on any other name.
std::uint64_t SeedOfName(const std::string& name, const std::string& file);

}  // namespace prospect::model
