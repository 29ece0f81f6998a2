#pragma once

#include <hdf5.h>

#include <string>
#include <vector>

namespace prospect::model {

/// What an open HDF5 file holds that is whole but no data set of ours, in words for a person: other
/// people's demonstrations with their cameras, or the names at its root. Empty where it looks like
/// one of ours, damaged or not.
std::string ForeignWords(hid_t file, const std::string& path);

/// Names of the pictures of a camera that a demonstration has: arrays [N,height,width,1, 3 or 4] of
/// its group "obs".
std::vector<std::string> CameraNames(hid_t demo, const std::string& path);

}  // namespace prospect::model
