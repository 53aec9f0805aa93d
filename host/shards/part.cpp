#include "host/shards/part.hpp"

#include <algorithm>
#include <charconv>
#include <iterator>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>

#include "host/core/checksum.hpp"
#include "host/core/error.hpp"
#include "host/core/escaped_text.hpp"
#include "host/core/json_depth.hpp"
#include "host/core/json_number.hpp"

namespace eyeray::engine::shards {
namespace {

using Json = nlohmann::ordered_json;

// Limits of scenes (docs/scene-reference.md).
constexpr int64_t most_pixels_of_picture = int64_t{1} << 28;
constexpr int most_pixels_of_side = 65536;

[[noreturn]] void nonsense(const char* what) {
  throw Error(ExitCode::file_io, "it is damaged: {}", what);
}

// Parses a text and returns read(json). Error (file_io) if this program did not write it.
template <typename Read>
auto read_json(const std::string& text, const char* what, const Read& read) {
  try {
    return read(Json::parse(unless_too_deep(text)));
  } catch (const Json::exception&) {
    nonsense(what);
  } catch (const std::out_of_range&) {
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
  for (size_t i = 0; i < std::size(members); ++i) *members[i] = whole_number<uint64_t>(json.at(i));
  return kinds;
}

Json to_json(const film::LegendTally& legend) {
  Json entries = Json::array();
  for (const auto& [index, entry] : legend.entries) entries.push_back({index, entry.text, entry.pixels});
  return {{"nothing", legend.nothing}, {"entries", std::move(entries)}};
}

film::LegendTally legend_of(const Json& json) {
  film::LegendTally legend{whole_number<uint64_t>(json.at("nothing")), {}};
  for (const Json& entry : json.at("entries"))
    legend.entries[whole_number<uint64_t>(entry.at(0))] = {entry.at(1).get<std::string>(),
                                                           whole_number<uint64_t>(entry.at(2))};
  return legend;
}

// The counts that are not 0, with their indices: most counts are 0.
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
  for (const film::Channel aov : header.aovs) aovs.push_back(aov->name);
  const Rect& area = header.area;
  return json_text(Json{{"shard", {header.shard.index, header.shard.count}},
                        {"scene", header.scene},
                        {"area", {area.x, area.y, area.width, area.height}},
                        {"samples", header.samples},
                        {"exposure", header.tone.exposure},
                        {"curve", int(header.tone.curve)},
                        {"white_balance", header.tone.white_balance},
                        {"transparent", header.transparent},
                        {"clamp", header.clamp},
                        {"random_paths", header.random_paths},
                        {"device", header.device},
                        {"build", header.build},
                        {"aovs", aovs},
                        {"identity", identity}});
}

PartHeader header_of(const std::string& text) {
  return read_json(text, "its header is invalid", [](const Json& json) {
    PartHeader header;
    header.shard.count = whole_number<int>(json.at("shard").at(1), 1, render::most_shards);
    header.shard.index = whole_number<int>(json.at("shard").at(0), 0, header.shard.count - 1);
    header.scene = json.at("scene").get<std::string>();
    const Json& area = json.at("area");
    header.area.x = whole_number<int>(area.at(0), 0, most_pixels_of_side - 1);
    header.area.y = whole_number<int>(area.at(1), 0, most_pixels_of_side - 1);
    header.area.width = whole_number<int>(area.at(2), 1, most_pixels_of_side - header.area.x);
    header.area.height = whole_number<int>(area.at(3), 1, most_pixels_of_side - header.area.y);
    header.samples = whole_number<int>(json.at("samples"), 1);
    header.tone.exposure = json.at("exposure").get<double>();
    header.tone.curve =
        image::ToneCurve(whole_number<int>(json.at("curve"), 0, int(std::size(image::tone_curves)) - 1));
    header.tone.white_balance = json.at("white_balance").get<double>();
    header.transparent = json.at("transparent").get<bool>();
    header.clamp = json.at("clamp").get<double>();
    header.random_paths = json.at("random_paths").get<bool>();
    header.device = json.at("device").get<std::string>();
    header.build = json.at("build").get<std::string>();
    for (const Json& name : json.at("aovs")) {
      const auto found =
          std::ranges::find(film::channel_types(), name.get<std::string>(), &film::ChannelType::name);
      if (found == film::channel_types().end())
        throw Error(ExitCode::file_io, "this eyeray has no AOV {}", name.get<std::string>());
      header.aovs.push_back(&*found);
    }
    for (const Json& part : json.at("identity"))
      header.identity.push_back(
          {part.at(0).get<std::string>(), part.at(1).get<std::string>(), part.at(2).get<bool>()});

    if (header.area.pixels() > most_pixels_of_picture) nonsense("its header is invalid");
    return header;
  });
}

std::string to_text(const PartTotals& totals) {
  Json legends = Json::array();
  for (const film::LegendTally& legend : totals.legends) legends.push_back(to_json(legend));
  return json_text(Json{{"rays", totals.rays},
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
  return read_json(text, "its totals are invalid", [](const Json& json) {
    PartTotals totals;
    totals.rays = whole_number<uint64_t>(json.at("rays"));
    totals.flagged_pixels = whole_number<uint64_t>(json.at("flagged_pixels"));
    totals.flagged_hits = whole_number<uint64_t>(json.at("flagged_hits"));
    totals.flags = whole_number<uint32_t>(json.at("flags"));
    totals.clamped = whole_number<uint64_t>(json.at("clamped"));
    for (const Json& count : json.at("brightness")) {
      auto& counts = totals.brightness.counts();
      counts[whole_number<size_t>(count.at(0), 0, counts.size() - 1)] = whole_number<uint64_t>(count.at(1));
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
                "--shard must be I/N, such as 3/64: the I-th of N shares, at most {}, not '{}'",
                render::most_shards, text);
  return {number - 1, count};
}

}  // namespace eyeray::engine::shards
