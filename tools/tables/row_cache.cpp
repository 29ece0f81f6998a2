#include "tools/tables/row_cache.h"

#include <fstream>
#include <nlohmann/json.hpp>

#include "base/json_file.h"

namespace prospect::tools {
namespace {

using nlohmann::json;

json AsJson(const Row& row) {
  json trials = json::array();
  for (const Row::Trial& t : row.trials) {
    trials.push_back({t.seed, t.succeeded, t.sums.examples, t.sums.extras, t.sums.by_c,
                      t.sums.labelled, t.sums.sum});
  }
  return trials;
}

Row RowOf(const json& trials) {
  Row row;
  for (const json& t : trials) {
    Row::Trial trial;
    trial.seed = t.at(0).get<std::uint64_t>();
    trial.succeeded = t.at(1).get<bool>();
    trial.sums.examples = t.at(2).get<double>();
    trial.sums.extras = t.at(3).get<double>();
    trial.sums.by_c = t.at(4).get<double>();
    trial.sums.labelled = t.at(5).get<double>();
    trial.sums.sum = t.at(6).get<decltype(trial.sums.sum)>();
    row.trials.push_back(trial);
  }
  return row;
}

std::vector<Row> Stored(const std::string& path, const std::string& key) {
  std::ifstream in(path);
  const json stored = json::parse(in, nullptr, false);
  std::vector<Row> rows;
  try {
    if (stored.at("key").get<std::string>() != key) return {};
    for (const json& row : stored.at("rows")) rows.push_back(RowOf(row));
  } catch (const json::exception&) {
    return {};
  }
  return rows;
}

}  // namespace

std::vector<Row> CachedRows(const std::string& path, const std::string& key,
                            const std::function<std::vector<Row>()>& make) {
  std::vector<Row> rows = Stored(path, key);
  if (!rows.empty()) return rows;
  rows = make();
  json stored = {{"key", key}, {"rows", json::array()}};
  for (const Row& row : rows) stored["rows"].push_back(AsJson(row));
  base::WriteJsonFile(path, stored, -1);
  return rows;
}

}  // namespace prospect::tools
