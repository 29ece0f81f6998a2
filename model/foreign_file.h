#pragma once

#include <hdf5.h>

#include <string>

namespace prospect::model {

/// What an open HDF5 file holds that is whole but no data set of ours, in words for a person: other
/// people's demonstrations with their cameras, or the names at its root. Empty where it looks like
/// one of ours, damaged or not.
std::string ForeignWords(hid_t file, const std::string& path);

}  // namespace prospect::model
