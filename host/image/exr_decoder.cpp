#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <ImfTileDescriptionAttribute.h>

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <set>

#include "host/core/error.hpp"
#include "host/image/exr_file.hpp"
#include "host/image/exr_header.hpp"
#include "host/image/image_file.hpp"

namespace eyeray::engine::image {

namespace {

// The largest number of bytes that one byte of a file can expand to. Deflate expands a byte to at most 1032
// (RFC 1951), other compressions to fewer. But DWA stores a uniform block of 8 · 8 halves as two bytes, and
// deflates these.
constexpr uint64_t most_deflated = 1032;
constexpr uint64_t most_of_cosines = 64 * most_deflated;
// Limit on the pixels of a tile.
constexpr uint64_t most_in_tile = 1 << 24;

// Attributes that give the numbers another meaning than linear Rec. 709.
constexpr const char* color_attributes[] = {"acesImageContainerFlag", "adoptedNeutral", "colorInteropID",
                                            "oiio:ColorSpace", "whiteLuminance"};
// Values of theirs that mean linear Rec. 709.
constexpr std::string_view linear_names[] = {"Linear",   "lin_rec709", "lin_rec709_scene",
                                             "lin_srgb", "linear",     "scene_linear"};

class MemoryStream final : public Imf::IStream {
 public:
  MemoryStream(std::string_view bytes, const std::string& name) : Imf::IStream(name.c_str()), bytes_(bytes) {}

  bool read(char to[], int count) override {
    if (count < 0 || at_ > bytes_.size() || size_t(count) > bytes_.size() - at_)
      throw std::runtime_error("it ends too early");
    std::memcpy(to, bytes_.data() + at_, size_t(count));
    at_ += size_t(count);
    return at_ < bytes_.size();
  }
  uint64_t tellg() override { return at_; }
  void seekg(uint64_t at) override { at_ = at; }

 private:
  std::string_view bytes_;
  uint64_t at_ = 0;
};

struct Channel {
  int part;
  std::string name;       // the full name in its part
  std::string layer;      // "" for the picture itself
  std::string component;  // the name without the layer
};

class ExrReader {
 public:
  ExrReader(std::string_view bytes, const std::string& name)
      : name_(name), size_(bytes.size()), stream_(bytes, name), file_(stream_, 0, false) {
    for (int part = 0; part < file_.parts(); ++part) {
      const Imf::Header& header = file_.header(part);
      if (header.hasType() && Imf::isDeepData(header.type())) fail("it contains deep data");
      const std::string part_name = header.hasName() ? header.name() : "";
      for (auto it = header.channels().begin(); it != header.channels().end(); ++it) {
        const std::string full = it.name();
        const size_t dot = full.rfind('.');
        Channel channel{part, full, "", dot == std::string::npos ? full : full.substr(dot + 1)};
        if (dot != std::string::npos) channel.layer = full.substr(0, dot);
        if (channel.layer.empty() && part > 0) channel.layer = part_name;
        if (part == 0) first_part_ = part_name;
        channels_.push_back(std::move(channel));
      }
    }
  }

  Image read(const std::string& layer, std::vector<std::string>& warnings) {
    const std::vector<Channel> chosen = choose(layer);
    const Imf::Header& header = file_.header(chosen[0].part);
    if (Imf::hasChromaticities(header) && !is_rec709(Imf::chromaticities(header)))
      warnings.push_back(name_ +
                         ": its chromaticities are not those of Rec. 709; its numbers are used unchanged");
    for (const char* const attribute : color_attributes) {
      if (header.find(attribute) == header.end()) continue;
      const auto* const text = header.findTypedAttribute<Imf::StringAttribute>(attribute);
      if (!text || std::ranges::find(linear_names, text->value()) == std::end(linear_names))
        warnings.push_back(
            fmt::format("{}: its {} is not applied; its numbers are used unchanged", name_, attribute));
    }
    if (layer.empty() && std::ranges::any_of(chosen, [](const Channel& c) { return c.component == "Z"; }))
      warnings.push_back(chosen.size() == 1 ? name_ + ": its channel Z, usually a depth, is read as grey"
                                            : name_ +
                                                  ": its channels X, Y and Z are read as red, green and "
                                                  "blue");
    if (header.pixelAspectRatio() != 1)
      warnings.push_back(name_ + ": its pixelAspectRatio is not 1; pixels are read as squares");
    if (Imf::hasEnvmap(header) && Imf::envmap(header) == Imf::ENVMAP_CUBE)
      warnings.push_back(name_ + ": it contains the faces of a cube (envmap), which are read as one picture");
    return in_display_window(read_channels(chosen), header);
  }

  std::optional<Image> read_alpha() {
    std::vector<Channel> all = in_layer("");
    std::erase_if(all, [](const Channel& channel) { return channel.component != "A"; });
    if (all.empty()) return std::nullopt;
    return in_display_window(read_channels({all[0]}), file_.header(all[0].part));
  }

  // The channels that read("") and read_alpha() leave out.
  std::vector<std::string> left_out() const {
    const std::vector<Channel> chosen = choose("");
    std::vector<std::string> names;
    for (const Channel& channel : channels_) {
      const bool same_layer = channel.part == chosen[0].part && channel.layer == chosen[0].layer;
      const bool read = std::ranges::any_of(
          chosen, [&](const Channel& one) { return one.part == channel.part && one.name == channel.name; });
      if (read || (same_layer && channel.component == "A")) continue;
      const bool named = channel.name.find('.') != std::string::npos || channel.layer.empty();
      names.push_back(named ? channel.name : channel.layer + "." + channel.name);
    }
    return names;
  }

  [[noreturn]] void fail(const std::string& why) const {
    throw Error(ExitCode::file_io, "cannot read {} as EXR: {}", name_, why);
  }

 private:
  static bool is_rec709(const Imf::Chromaticities& given) {
    const Imf::Chromaticities usual;
    const auto near = [](const Imath::V2f& a, const Imath::V2f& b) { return (a - b).length() < 0.002f; };
    return near(given.red, usual.red) && near(given.green, usual.green) && near(given.blue, usual.blue) &&
           near(given.white, usual.white);
  }

  // The data window's pixels, moved to their positions in the display window.
  Image in_display_window(Image data, const Imf::Header& header) const {
    const Imath::Box2i from = header.dataWindow(), to = header.displayWindow();
    if (from == to) return data;
    const int64_t width = int64_t{to.max.x} - to.min.x + 1, height = int64_t{to.max.y} - to.min.y + 1;
    if (!image_size_allowed(width, height)) fail("the size of its display window is out of range");
    Image image(int(width), int(height), data.channels());
    const int first = std::max(from.min.x, to.min.x), last = std::min(from.max.x, to.max.x);
    if (first > last) return image;
    for (int y = std::max(from.min.y, to.min.y); y <= std::min(from.max.y, to.max.y); ++y)
      std::copy_n(data.pixel(first - from.min.x, y - from.min.y), (last - first + 1) * data.channels(),
                  image.pixel(first - to.min.x, y - to.min.y));
    return image;
  }

  Image read_channels(const std::vector<Channel>& chosen) {
    const Imf::Header& header = file_.header(chosen[0].part);
    const Imath::Box2i window = header.dataWindow();
    const int64_t width = int64_t{window.max.x} - window.min.x + 1,
                  height = int64_t{window.max.y} - window.min.y + 1;
    check_size(header, width, height);

    Image image(int(width), int(height), chosen.size() == 1 ? 1 : 3);
    const size_t stride = size_t(image.channels()) * sizeof(float);
    Imf::FrameBuffer buffer;
    for (size_t c = 0; c < chosen.size(); ++c)
      buffer.insert(chosen[c].name, Imf::Slice::Make(Imf::FLOAT, image.samples().data() + c, window, stride,
                                                     stride * size_t(width)));
    Imf::InputPart part(file_, chosen[0].part);
    part.setFrameBuffer(buffer);
    part.readPixels(window.min.y, window.max.y);
    return image;
  }

  std::vector<Channel> in_layer(const std::string& layer) const {
    std::vector<Channel> found;
    for (const Channel& channel : channels_)
      if ((channel.layer == layer || (channel.layer.empty() && layer == first_part_)) &&
          (found.empty() || found[0].part == channel.part))
        found.push_back(channel);
    return found;
  }

  std::string layers() const {
    std::set<std::string> names;
    for (const Channel& channel : channels_) names.insert(channel.layer);
    names.erase("");
    return fmt::format("{}", fmt::join(names, ", "));
  }

  // The channels of the layer that form a picture, in the picture's order.
  std::vector<Channel> choose(const std::string& layer) const {
    std::vector<Channel> all = in_layer(layer);
    if (all.empty() && layer.empty() && !channels_.empty()) {
      all = in_layer(channels_[0].layer);
      if (all.size() < channels_.size()) fail(fmt::format("it has several layers; name one of {}", layers()));
    }
    if (all.empty())
      fail(layer.empty() ? "it has no channels"
                         : fmt::format("it has no layer '{}'{}", layer,
                                       layers().empty() ? "" : "; its layers are " + layers()));
    const auto find = [&](std::string_view component) {
      return std::ranges::find(all, component, &Channel::component);
    };
    const auto has = [&](std::string_view component) { return find(component) != all.end(); };
    if (has("RY") || has("BY")) fail("it contains luminance and chroma, not red, green and blue");
    for (const auto& names : {std::array{"R", "G", "B"}, {"X", "Y", "Z"}}) {
      const auto missing = std::ranges::find_if_not(names, has);
      if (missing == names.end()) return {*find(names[0]), *find(names[1]), *find(names[2])};
      if (names[0][0] == 'R' && std::ranges::any_of(names, has))
        fail(fmt::format("it lacks the channel {}", *missing));
    }
    if (has("Y") && !has("X")) return {*find("Y")};
    std::erase_if(all, [](const Channel& channel) { return channel.component == "A"; });
    if (all.empty() || all.size() > 3)
      fail(fmt::format("a picture must have one to three channels, not {}", all.size()));
    return all;
  }

  void check_size(const Imf::Header& header, int64_t width, int64_t height) const {
    if (!image_size_allowed(width, height)) fail("its size is out of range");
    uint64_t pixel = 0;
    for (auto it = header.channels().begin(); it != header.channels().end(); ++it) {
      if (it.channel().xSampling != 1 || it.channel().ySampling != 1)
        fail(fmt::format("its channel {} is subsampled", it.name()));
      pixel += it.channel().type == Imf::HALF ? 2 : 4;
    }
    if (header.hasTileDescription()) {
      const Imf::TileDescription& tile = header.tileDescription();
      if (uint64_t{tile.xSize} * tile.ySize > most_in_tile) fail("its tiles are too large");
    }
    const Imf::Compression kind = header.compression();
    const bool cosines = kind == Imf::DWAA_COMPRESSION || kind == Imf::DWAB_COMPRESSION;
    const uint64_t share = cosines ? most_of_cosines : most_deflated;
    if (uint64_t(width) * uint64_t(height) * pixel / share > size_) fail("it ends too early");
  }

  const std::string& name_;
  size_t size_;
  MemoryStream stream_;
  Imf::MultiPartInputFile file_;
  std::vector<Channel> channels_;
  std::string first_part_;  // the first part's name, which also stands for the layer ""
};

// Calls `read` with a reader of the file, and returns its value.
template <typename Read>
auto with_reader(std::string_view bytes, const std::string& name, const Read& read) {
  // Sets the limits before the library takes memory for the size that a header states.
  static const bool limited = [] {
    Imf::Header::setMaxImageSize(65536, 65536);
    Imf::Header::setMaxTileSize(65536, 65536);
    return true;
  }();
  CHECK(limited);
  if (!exr_header_sound(bytes))
    throw Error(ExitCode::file_io,
                "cannot read {} as EXR: its header is damaged, lacks a window or channels, or ends too early",
                name);
  try {
    ExrReader reader(bytes, name);
    return read(reader);
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw Error(ExitCode::file_io, "cannot read {} as EXR: {}", name, error.what());
  }
}

}  // namespace

Image decode_exr(std::string_view bytes, const std::string& name, const std::string& layer,
                 std::vector<std::string>& warnings) {
  return with_reader(bytes, name, [&](ExrReader& reader) { return reader.read(layer, warnings); });
}

std::optional<Image> decode_exr_alpha(std::string_view bytes, const std::string& name) {
  return with_reader(bytes, name, [](ExrReader& reader) { return reader.read_alpha(); });
}

std::vector<std::string> exr_channels_left_out(std::string_view bytes, const std::string& name) {
  return with_reader(bytes, name, [](ExrReader& reader) { return reader.left_out(); });
}

}  // namespace eyeray::engine::image
