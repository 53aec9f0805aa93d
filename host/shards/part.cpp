#include "host/shards/part.hpp"

#include <algorithm>
#include <charconv>
#include <iterator>
#include <nlohmann/json.hpp>
#include <span>

#include "host/core/checksum.hpp"
#include "host/core/error.hpp"
#include "host/core/json_depth.hpp"

namespace eyeray::shards {
namespace {

using Json = nlohmann::ordered_json;

// As renders allow them (docs/command-line.md).
constexpr int64_t most_pixels_of_picture = int64_t{1} << 28;

// File names may hold any bytes; JSON may not.
std::string dumped(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

[[noreturn]] void nonsense(const char* what) {
  throw Error(ExitCode::file_io, "it is damaged: {}", what);
}

// What read(json) makes of a text that was written by this program; Error (file_io) where it was not.
template <typename Read>
auto read_json(const std::string& text, const char* what, const Read& read) {
  try {
    return read(Json::parse(unless_too_deep(text)));
  } catch (const Json::exception&) {
    nonsense(what);
  }
}

Json to_json(const RayCounts& kinds) {
  return {kinds.eye,     kinds.eye_hits, kinds.reflected, kinds.refracted, kinds.total_reflections,
          kinds.cut_off, kinds.shadow};
}

RayCounts ray_counts_of(const Json& json) {
  RayCounts kinds;
  uint64_t* const members[] = {&kinds.eye,       &kinds.eye_hits,          &kinds.reflected,
                               &kinds.refracted, &kinds.total_reflections, &kinds.cut_off,
                               &kinds.shadow};
  for (size_t i = 0; i < std::size(members); ++i) *members[i] = json.at(i).get<uint64_t>();
  return kinds;
}

Json to_json(const aov::LegendTally& legend) {
  Json entries = Json::array();
  for (const auto& [index, entry] : legend.entries) entries.push_back({index, entry.text, entry.pixels});
  return {{"nothing", legend.nothing}, {"entries", std::move(entries)}};
}

aov::LegendTally legend_of(const Json& json) {
  aov::LegendTally legend{json.at("nothing").get<uint64_t>(), {}};
  for (const Json& entry : json.at("entries"))
    legend.entries[entry.at(0).get<uint64_t>()] = {entry.at(1).get<std::string>(),
                                                   entry.at(2).get<uint64_t>()};
  return legend;
}

// Where the counts are not 0: most are.
Json to_json(const render::Brightness& brightness) {
  Json json = Json::array();
  for (size_t i = 0; i < brightness.counts().size(); ++i)
    if (brightness.counts()[i] > 0) json.push_back({i, brightness.counts()[i]});
  return json;
}

}  // namespace

std::string to_text(const PartHeader& header) {
  Json identity = Json::array(), aovs = Json::array();
  for (const render::IdentityPart& part : header.identity)
    identity.push_back({part.name, part.value, part.shown});
  for (const aov::Aov aov : header.aovs) aovs.push_back(aov->name);
  const Rect& area = header.area;
  return dumped({{"shard", {header.shard.index, header.shard.count}},
                 {"scene", header.scene},
                 {"area", {area.x, area.y, area.width, area.height}},
                 {"samples", header.samples},
                 {"exposure", header.tone.exposure},
                 {"curve", int(header.tone.curve)},
                 {"clamp", header.clamp},
                 {"random_paths", header.random_paths},
                 {"device", header.device},
                 {"build", header.build},
                 {"aovs", aovs},
                 {"identity", identity}});
}

PartHeader header_of(const std::string& text) {
  return read_json(text, "its header makes no sense", [](const Json& json) {
    PartHeader header;
    header.shard = {json.at("shard").at(0).get<int>(), json.at("shard").at(1).get<int>()};
    header.scene = json.at("scene").get<std::string>();
    const Json& area = json.at("area");
    header.area = {area.at(0).get<int>(), area.at(1).get<int>(), area.at(2).get<int>(),
                   area.at(3).get<int>()};
    header.samples = json.at("samples").get<int>();
    header.tone.exposure = json.at("exposure").get<double>();
    header.tone.curve = image::ToneCurve(json.at("curve").get<int>());
    header.clamp = json.at("clamp").get<double>();
    header.random_paths = json.at("random_paths").get<bool>();
    header.device = json.at("device").get<std::string>();
    header.build = json.at("build").get<std::string>();
    for (const Json& name : json.at("aovs")) {
      const auto found = std::ranges::find(aov::aov_types(), name.get<std::string>(), &aov::AovType::name);
      if (found == aov::aov_types().end())
        throw Error(ExitCode::file_io, "this eyeray has no AOV {}", name.get<std::string>());
      header.aovs.push_back(&*found);
    }
    for (const Json& part : json.at("identity"))
      header.identity.push_back(
          {part.at(0).get<std::string>(), part.at(1).get<std::string>(), part.at(2).get<bool>()});

    const render::Shard& shard = header.shard;
    const Rect& whole = header.area;
    if (shard.count > render::most_shards || shard.index < 0 || shard.index >= shard.count || whole.x < 0 ||
        whole.y < 0 || whole.width < 1 || whole.height < 1 || whole.pixels() > most_pixels_of_picture ||
        header.samples < 1 || size_t(header.tone.curve) >= std::size(image::tone_curves))
      nonsense("its header makes no sense");
    return header;
  });
}

std::string to_text(const PartTotals& totals) {
  Json legends = Json::array();
  for (const aov::LegendTally& legend : totals.legends) legends.push_back(to_json(legend));
  return dumped({{"rays", totals.rays},
                 {"flagged_pixels", totals.flagged_pixels},
                 {"flagged_hits", totals.flagged_hits},
                 {"flags", totals.flags},
                 {"clamped", totals.clamped},
                 {"brightness", to_json(totals.brightness)},
                 {"ray_kinds", totals.ray_kinds ? to_json(*totals.ray_kinds) : Json()},
                 {"seconds", totals.seconds},
                 {"processor_seconds", totals.processor_seconds},
                 {"legends", legends}});
}

PartTotals totals_of(const std::string& text) {
  return read_json(text, "its totals make no sense", [](const Json& json) {
    PartTotals totals;
    totals.rays = json.at("rays").get<uint64_t>();
    totals.flagged_pixels = json.at("flagged_pixels").get<uint64_t>();
    totals.flagged_hits = json.at("flagged_hits").get<uint64_t>();
    totals.flags = json.at("flags").get<uint32_t>();
    totals.clamped = json.at("clamped").get<uint64_t>();
    for (const Json& count : json.at("brightness")) {
      const auto place = count.at(0).get<size_t>();
      if (place >= totals.brightness.counts().size()) nonsense("its totals make no sense");
      totals.brightness.counts()[place] = count.at(1).get<uint64_t>();
    }
    if (const Json& kinds = json.at("ray_kinds"); !kinds.is_null()) totals.ray_kinds = ray_counts_of(kinds);
    totals.seconds = json.at("seconds").get<double>();
    totals.processor_seconds = json.at("processor_seconds").get<double>();
    for (const Json& legend : json.at("legends")) totals.legends.push_back(legend_of(legend));
    return totals;
  });
}

void PartTotals::add(const PartTotals& other) {
  rays += other.rays;
  flagged_pixels += other.flagged_pixels;
  flagged_hits += other.flagged_hits;
  flags |= other.flags;
  clamped += other.clamped;
  brightness.add(other.brightness);
  if (ray_kinds && other.ray_kinds)
    ray_kinds->add(*other.ray_kinds);
  else
    ray_kinds.reset();
  seconds += other.seconds;
  processor_seconds += other.processor_seconds;
  for (size_t i = 0; i < legends.size(); ++i) legends[i].add(other.legends[i]);
}

uint32_t plane_checksum(uint32_t header_checksum, size_t plane) {
  const uint64_t number = plane;
  return crc32(std::as_bytes(std::span(&number, 1)), header_checksum);
}

std::string shard_text(const render::Shard& shard) {
  return fmt::format("{}/{}", shard.index + 1, shard.count);
}

render::Shard parse_shard(const std::string& text) {
  int number = 0, count = 0;
  const char* const end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, number);
  const bool slash = first.ec == std::errc() && first.ptr != end && *first.ptr == '/';
  const auto second = std::from_chars(slash ? first.ptr + 1 : end, end, count);
  if (!slash || second.ec != std::errc() || second.ptr != end || number < 1 || number > count ||
      count > render::most_shards)
    throw Error(ExitCode::bad_input,
                "--shard wants I/N, as 3/64: of N shares, at most {}, the I-th, not '{}'",
                render::most_shards, text);
  return {number - 1, count};
}

}  // namespace eyeray::shards
