#include "tools/common/parts.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <stdexcept>

#include "base/json_file.h"
#include "base/text.h"

#ifndef PROSPECT_VERSION
#error "the build defines PROSPECT_VERSION"
#endif

namespace prospect::tools {
namespace {

using nlohmann::json;

constexpr int kMostParts = 1000;  // as --shard takes

std::string NameOf(const Part& part) {
  return "part " + std::to_string(part.index) + " of " + std::to_string(part.count);
}

std::string InWords(const std::vector<std::string>& options) {
  return options.empty() ? "none" : base::Joined(options, " ");
}

// The first thing that two parts of one run have in common and these have not; empty: none.
std::string Difference(const Part& part, const Part& first) {
  if (part.command != first.command) return "of " + part.command + ", not of " + first.command;
  if (part.count != first.count) return NameOf(part) + ", not of " + std::to_string(first.count);
  if (part.options != first.options)
    return "made with other options: " + InWords(part.options) + "; not " + InWords(first.options);
  for (const auto& [name, value] : first.made_of.items()) {
    if (part.made_of.value(name, json()) != value)
      return "made with another " + name + ": " + part.made_of.value(name, json()).dump() +
             ", not " + value.dump();
  }
  return part.items == first.items ? "" : "of another number of items";
}

void RequireThisVersion(const NamedPart& named) {
  if (named.part.version == PROSPECT_VERSION) return;
  throw PartError(named.file + ": was made by version " + named.part.version +
                  ", this is " PROSPECT_VERSION ": merge with the version that made the parts");
}

void RequireSound(const Part& part, const std::string& file) {
  const bool sound = part.index >= 1 && part.index <= part.count && part.count <= part.items &&
                     part.count <= kMostParts && part.made_of.is_object();
  if (!sound) throw PartError(file + ": what it says of its run cannot be; damaged");
}

json ReadJson(const std::string& file) {
  std::ifstream stream(file);
  if (!stream) throw PartError(file + ": cannot be read");
  json read = json::parse(stream, nullptr, false);
  if (read.is_discarded()) throw PartError(file + ": is cut off or damaged: make this part anew");
  if (!read.is_object() || !read.contains("part"))
    throw PartError(file + ": is no part of a run: it was made without --shard");
  return read;
}

// Puts a part's records where they belong.
void Place(const Part& part, const std::string& file, const json& records,
           std::vector<std::string>* all) {
  const bool whole = records.is_array() && records.size() == static_cast<std::size_t>(SizeOf(part));
  if (!whole) throw PartError(file + ": does not hold its records; damaged: make this part anew");
  all->resize(static_cast<std::size_t>(part.items));
  for (std::size_t k = 0; k < records.size(); ++k) {
    const auto item =
        static_cast<std::size_t>(part.index - 1) + k * static_cast<std::size_t>(part.count);
    (*all)[item] = records[k].dump();
  }
}

}  // namespace

std::vector<int> ItemsOf(const cli::ShardOptions& shard, int items) {
  if (shard.given() && shard.count > items) {
    throw std::invalid_argument("--shard " + std::to_string(shard.index) + "/" +
                                std::to_string(shard.count) + ": more parts than the " +
                                std::to_string(items) + " that there are to do");
  }
  std::vector<int> own;
  const int step = shard.given() ? shard.count : 1;
  for (int i = shard.given() ? shard.index - 1 : 0; i < items; i += step) own.push_back(i);
  return own;
}

Part PartOf(const cli::ShardOptions& shard, const std::string& command, int items,
            const json& made_of) {
  return {shard.index, shard.count, command, shard.asked, made_of, items, PROSPECT_VERSION};
}

json ToJson(const Part& part) {
  return {{"index", part.index},     {"count", part.count},     {"command", part.command},
          {"options", part.options}, {"made_of", part.made_of}, {"items", part.items},
          {"version", part.version}};
}

Part PartFrom(const std::string& text, const std::string& file) {
  try {
    const json read = json::parse(text);
    Part part;
    read.at("index").get_to(part.index);
    read.at("count").get_to(part.count);
    read.at("command").get_to(part.command);
    read.at("options").get_to(part.options);
    part.made_of = read.at("made_of");
    read.at("items").get_to(part.items);
    read.at("version").get_to(part.version);
    RequireSound(part, file);
    return part;
  } catch (const json::exception&) {
    throw PartError(file + ": does not say of which run it is a part; damaged");
  }
}

int SizeOf(const Part& part) { return (part.items - part.index) / part.count + 1; }

void RequireOneRun(const std::vector<NamedPart>& parts) {
  if (parts.empty()) throw PartError("no part was given");
  std::map<int, std::string> files;  // by the part's index
  const NamedPart& first = parts.front();
  for (const NamedPart& named : parts) {
    RequireThisVersion(named);
    const std::string difference = Difference(named.part, first.part);
    if (!difference.empty())
      throw PartError(named.file + ": is not of the run of " + first.file + ": it is " +
                      difference);
    const auto [other, fresh] = files.emplace(named.part.index, named.file);
    if (!fresh)
      throw PartError(named.file + ": is " + NameOf(named.part) + ", and so is " + other->second);
  }
  for (int i = 1; i <= first.part.count; ++i) {
    if (files.contains(i)) continue;
    throw PartError("part " + std::to_string(i) + " of " + std::to_string(first.part.count) +
                    " is missing from the run of " + first.file);
  }
}

void WriteRecords(const std::string& file, const Part& part, const std::vector<json>& records) {
  base::WriteJsonFile(file, {{"part", ToJson(part)}, {"records", records}}, -1);
}

MergedRun ReadRecords(const std::vector<std::string>& files) {
  std::vector<json> contents;
  std::vector<NamedPart> parts;
  for (const std::string& file : files) {
    contents.push_back(ReadJson(file));
    parts.push_back({file, PartFrom(contents.back()["part"].dump(), file)});
  }
  RequireOneRun(parts);
  MergedRun run;
  for (std::size_t i = 0; i < parts.size(); ++i)
    Place(parts[i].part, parts[i].file, contents[i].value("records", json()), &run.parts.records);
  run.command = parts.front().part.command;
  run.options = parts.front().part.options;
  run.parts.made_of = parts.front().part.made_of.dump();
  return run;
}

}  // namespace prospect::tools
