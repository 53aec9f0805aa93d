#include "host/cli/merged_report.hpp"

#include <fmt/ranges.h>

#include <map>
#include <nlohmann/json.hpp>

#include "host/core/atomic_file.hpp"
#include "host/core/error.hpp"
#include "host/core/json_depth.hpp"
#include "host/core/json_number.hpp"
#include "host/shards/part_set.hpp"

namespace eyeray::engine::cli {
namespace {

struct ShardReport {
  std::string file;
  int index = 0, count = 0;
  size_t suite_size = 0;
  std::string suite;
  bool passed = false;
  Json scenes;
};

ShardReport read_report(const std::string& file) {
  const std::string text = read_file(file);
  try {
    Json json = Json::parse(unless_too_deep(text));
    const Json& shard = json.at("shard");
    const int count = whole_number<int>(shard.at("count"), 1, render::most_shards);
    ShardReport report{file,
                       whole_number<int>(shard.at("index"), 1, count) - 1,
                       count,
                       whole_number<size_t>(shard.at("suite_size")),
                       shard.at("suite").get<std::string>(),
                       json.at("passed").get<bool>(),
                       std::move(json.at("scenes"))};
    const auto index = size_t(report.index);
    const size_t scenes = index < report.suite_size ? (report.suite_size - index - 1) / size_t(count) + 1 : 0;
    if (!report.scenes.is_array() || report.scenes.size() != scenes)
      throw Error(ExitCode::file_io, "{}: it is damaged: it lacks scenes of its share", file);
    return report;
  } catch (const Json::exception&) {
    throw Error(ExitCode::file_io, "{}: it is not a report of verify --shard I/N --json", file);
  } catch (const std::out_of_range&) {
    throw Error(ExitCode::file_io, "{}: it is not a report of verify --shard: its share is invalid", file);
  }
}

}  // namespace

Json shard_of_report(const render::Shard& shard, size_t scenes, const std::string& suite) {
  return {{"index", shard.index + 1}, {"count", shard.count}, {"suite_size", scenes}, {"suite", suite}};
}

Json merged_report(const std::vector<std::string>& files) {
  std::map<int, ShardReport> reports;
  shards::PartFaults faults;
  for (const std::string& file : files) {
    ShardReport report = read_report(file);
    if (!reports.empty()) {
      const ShardReport& first = reports.begin()->second;
      if (report.suite != first.suite || report.count != first.count) {
        faults.foreign.push_back(
            fmt::format("{} has other scenes, options or shares than {}", file, first.file));
        continue;
      }
    }
    const int index = report.index;
    const auto [other, added] = reports.try_emplace(index, std::move(report));
    if (!added)
      faults.doubled.push_back(fmt::format("{} and {} are both {}", other->second.file, file,
                                           shards::shard_text({index, other->second.count})));
  }
  faults.count = reports.begin()->second.count;
  for (int i = 0; i < faults.count; ++i)
    if (!reports.contains(i)) faults.missing.push_back(i);
  if (faults.any()) throw Error(ExitCode::bad_input, "these reports cannot be merged: {}", faults.text());

  // Scene i belongs to the share with number i modulo the number of shares.
  Json scenes = Json::array();
  bool passed = true;
  for (const auto& [index, report] : reports) passed = passed && report.passed;
  const size_t all = reports.begin()->second.suite_size;
  for (size_t i = 0; i < all; ++i) {
    ShardReport& report = reports.at(int(i % size_t(faults.count)));
    scenes.push_back(std::move(report.scenes[i / size_t(faults.count)]));
  }
  return {{"passed", passed && all > 0}, {"scenes", std::move(scenes)}};
}

}  // namespace eyeray::engine::cli
