#pragma once

#include <map>
#include <string>
#include <vector>

#include "model/segments/segmentation.h"

namespace prospect::model::segments {

/// A row of a CSV file: from when to when an action ran, and whether it succeeded.
struct CsvRow {
  double start = 0, end = 0;  ///< seconds, or frames from 0
  int action = 0;
  bool succeeded = true;
  std::string cause;
  int line = 0;
};

/// Reads "start,end,action,succeeded" a row, and perhaps a cause of failure behind them. The first
/// line may name the columns; lines that are empty or begin with # are skipped; what holds a comma
/// stands in quotation marks. An action is a name of `names` or its number; succeeded is 1 or 0,
/// yes or no, true or false. Throws DataError, naming file and line.
std::vector<CsvRow> ReadSegmentCsv(const std::string& path, const std::vector<std::string>& names);

/// The same with a demonstration's name before each row: "demo,start,end,action,succeeded".
std::map<std::string, std::vector<CsvRow>> ReadDemoCsv(const std::string& path,
                                                       const std::vector<std::string>& names);

/// Rows in seconds as spans of a video. An action that ends when the next begins ends on the frame
/// before that; a video's frame belongs to the time at which it is shown. Throws as InOrder.
Segmentation FromSeconds(const std::vector<CsvRow>& rows, double frames_per_second,
                         const std::string& path);

/// Rows in frames. Throws as InOrder.
Segmentation FromFrames(const std::vector<CsvRow>& rows, const std::string& path);

}  // namespace prospect::model::segments
