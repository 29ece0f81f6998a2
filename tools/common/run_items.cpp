#include "tools/common/run_items.h"

#include <cstdio>
#include <utility>

#include "base/quiet.h"
#include "tools/common/fork_map.h"
#include "tools/common/parts.h"
#include "tools/common/progress.h"

namespace prospect::tools {
namespace {

using nlohmann::json;

// What the parts were made of must be what is here, since the report tells it, too.
void RequireSame(const json& made, const json& here) {
  for (const auto& [name, value] : here.items()) {
    if (made.value(name, json()) == value) continue;
    throw PartError("the parts were made with " + name + " " + made.value(name, json()).dump() +
                    ", here it is " + value.dump());
  }
}

ItemRuns Merged(const cli::MergedParts& merged, const Items& items) {
  RequireSame(json::parse(merged.made_of), items.made_of);
  if (merged.records.size() != static_cast<std::size_t>(items.count))
    throw PartError("the parts hold another number of " + items.what + " than the run has");
  ItemRuns runs;
  for (const std::string& record : merged.records) runs.records.push_back(json::parse(record));
  runs.extent = {items.count, items.count};
  return runs;
}

}  // namespace

ItemRuns RunItems(const cli::ShardOptions& shard, const Items& items,
                  const std::function<std::function<std::string(int)>()>& make_work,
                  const std::function<std::string(const json&)>& note) {
  if (shard.merged) return Merged(*shard.merged, items);
  const std::vector<int> own = ItemsOf(shard, items.count);
  std::vector<json> records(own.size());
  Progress progress(items.what, static_cast<int>(own.size()));
  ItemRuns runs;
  runs.extent = ForkMap(
      static_cast<int>(own.size()), items.jobs,
      [&] {
        return [work = make_work(), &own](int i) { return work(own[static_cast<std::size_t>(i)]); };
      },
      [&](int i, const std::string& line) {
        json& record = records[static_cast<std::size_t>(i)];
        record = json::parse(line);
        progress.Step(note ? note(record) : "");
      });
  for (json& record : records) {
    if (!record.is_null()) runs.records.push_back(std::move(record));
  }
  return runs;
}

int WritePart(const cli::ShardOptions& shard, const cli::ReportOptions& report,
              const std::string& command, const Items& items, const ItemRuns& runs) {
  if (runs.extent.stopped())
    throw Interrupted(runs.extent.Words(items.what) + " of this part; nothing is written");
  WriteRecords(report.json, PartOf(shard, command, items.count, items.made_of), runs.records);
  if (!base::Quiet()) {
    std::printf("part %d of %d in %s; ./prospect merge joins all\n", shard.index, shard.count,
                report.json.c_str());
  }
  return runs.extent.exit_code();
}

}  // namespace prospect::tools
