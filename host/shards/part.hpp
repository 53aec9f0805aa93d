// A part: the result of one shard of a picture, in a file that names the picture.
//
// FILE, little-endian, written atomically:
//
//   offset   bytes
//   0        8       "EYERAYPT"
//   8        4       version of this layout: 2
//   12       4       n
//   16       4       CRC-32 of all above
//   20       n       PartHeader as JSON
//            4       CRC-32 of these n bytes
//            …       the planes: the picture, then each AOV. A plane has the shard's tiles in order
//                    (render/tiling.hpp). A tile has
//                      its pixels, row by row, each with one float32 for each channel of the plane;
//                      4 bytes: CRC-32 of the plane so far, which starts from the CRC-32 of the header and
//                      of the plane's number
//            4       m
//            m       PartTotals as JSON
//            4       CRC-32 of m and of these m bytes
//
// Checksums cover every byte. They detect every flipped bit, and every run of damage of up to 32 bits.
//
// Pixels are those of the picture: the means of their samples in float32. One shard takes all samples of a
// pixel, in the order in which one machine takes them, so that nothing is left to be added up.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/core/ray_counts.hpp"
#include "host/film/channel.hpp"
#include "host/film/legend.hpp"
#include "host/image/tone.hpp"
#include "host/render/brightness.hpp"
#include "host/render/checkpoint.hpp"
#include "host/render/tiling.hpp"

namespace eyeray::engine::shards {

// The facts of a part that are known before its first sample.
struct PartHeader {
  render::Shard shard;
  std::string scene;  // the scene's file, as it was named
  Rect area;          // the area of the picture that all parts together cover
  int samples = 1;    // per pixel
  image::Tone tone;
  bool transparent = false;   // whether the picture has an alpha
  double clamp = 0;           // RenderOptions::clamp
  bool random_paths = false;  // whether bright samples may be fireflies
  std::string device;         // for people
  std::string build;          // build/build_facts.hpp, sum_of_sources
  film::Channels aovs;
  // The facts that decide the bits: the same in all parts of one picture.
  std::vector<render::IdentityPart> identity;

  size_t planes() const { return 1 + aovs.size(); }
  int channels(size_t plane) const {
    return plane == 0 ? (transparent ? 4 : 3) : aovs[plane - 1]->components;
  }
};

// The facts of a part that are known after its last sample.
struct PartTotals {
  uint64_t rays = 0;
  uint64_t flagged_pixels = 0;
  uint64_t flagged_hits = 0;
  uint32_t flags = 0;
  uint64_t clamped = 0;
  render::Brightness brightness;
  std::optional<RayCounts> ray_kinds;      // where they were asked for
  double seconds = 0;                      // seconds of sampling
  double processor_seconds = 0;            // the same, of all threads
  std::vector<film::LegendTally> legends;  // one for each AOV, empty if it has no legend

  // Adds the totals of another part. Kinds of rays are known only if both know them.
  void add(const PartTotals& other);
};

// Conversions to the file's text, and back. The conversions back throw Error (file_io), which names the
// fault, for any other text.
std::string to_text(const PartHeader& header);
PartHeader header_of(const std::string& text);
std::string to_text(const PartTotals& totals);
PartTotals totals_of(const std::string& text);

inline constexpr std::string_view part_magic = "EYERAYPT";
inline constexpr uint32_t part_version = 2;
inline constexpr uint32_t part_prefix_bytes = 20;
inline constexpr uint32_t longest_part_header = 1 << 24;

// The initial value of a plane's checksums.
uint32_t plane_checksum(uint32_t header_checksum, size_t plane);

// "3/64": counted from 1, as people do.
std::string shard_text(const render::Shard& shard);
// Parses that text; Error (bad_input) if it names no shard.
render::Shard parse_shard(const std::string& text);

}  // namespace eyeray::engine::shards
