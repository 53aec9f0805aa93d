#include "host/importers/draco_mesh.hpp"

#include <draco/compression/entropy/symbol_decoding.h>
#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/core/varint_decoding.h>
#include <fmt/format.h>

#include <optional>
#include <vector>

namespace eyeray::engine::importers {

namespace {

// The number of values that store the connectivity, as the head of its data states it; empty if the data is
// cut short. `buffer` is a copy. Sequential data has three bytes a face, which Draco checks.
std::optional<uint64_t> connectivity_values(const draco::MeshSequentialDecoder&, draco::DecoderBuffer) {
  return 0;
}

std::optional<uint64_t> connectivity_values(const draco::MeshEdgebreakerDecoder& decoder,
                                            draco::DecoderBuffer buffer) {
  const uint16_t version = decoder.bitstream_version();
  const auto count = [&](uint32_t& value) {
    return version < DRACO_BITSTREAM_VERSION(2, 0) ? buffer.Decode(&value)
                                                   : draco::DecodeVarint(&value, &buffer);
  };
  uint32_t vertices = 0;
  uint32_t faces = 0;
  uint8_t attribute_tables = 0;
  if (version < DRACO_BITSTREAM_VERSION(2, 2) && !count(vertices))
    return std::nullopt;  // no count of the vertices that splits add
  if (!count(vertices) || !count(faces) || !buffer.Decode(&attribute_tables)) return std::nullopt;
  return uint64_t{3} * faces * (1 + attribute_tables);
}

// True if the data has at most `most` orientations. Draco 1.5.5 predicts uv by orientations, and reads and
// stores as many as the data claims, even 2^31. They follow the values; `buffer` is a copy of the data, and
// begins at the values.
bool orientations_within(uint64_t most, draco::DecoderBuffer buffer, bool plain_count, uint32_t entries,
                         int components) {
  uint8_t compressed = 0;
  uint8_t bytes = 0;
  const uint32_t values = entries * static_cast<uint32_t>(components);
  if (!buffer.Decode(&compressed)) return false;
  if (compressed > 0) {
    std::vector<uint32_t> skipped(values);
    if (!draco::DecodeSymbols(values, components, &buffer, skipped.data())) return false;
  } else {
    if (!buffer.Decode(&bytes) || int64_t{bytes} * values > buffer.remaining_size()) return false;
    buffer.Advance(int64_t{bytes} * values);
  }
  uint32_t orientations = 0;
  const bool read = plain_count ? buffer.Decode(&orientations) : draco::DecodeVarint(&orientations, &buffer);
  return read && orientations <= most;
}

// Draco's decoder, which checks the sizes that the data claims before it allocates memory.
template <typename Decoder>
class BoundedDecoder : public Decoder {
 public:
  explicit BoundedDecoder(uint64_t most) : most_(most) {}
  uint64_t values() const { return values_; }
  bool exceeded() const { return values_ > most_; }

 protected:
  bool DecodeConnectivity() override {
    const auto values = connectivity_values(*this, *this->buffer());
    return values && take(*values) && Decoder::DecodeConnectivity();
  }

  // When Draco calls this, the attributes are declared, and not yet decoded.
  bool DecodeAllAttributes() override {
    const draco::PointCloud& points = *this->point_cloud();
    uint64_t values = 0;
    for (int i = 0; i < points.num_attributes(); ++i)
      values += 1 + points.attribute(i)->num_components();  // 1: the vertex's index of its value
    attributes_ = this->buffer();
    return take(values * points.num_points()) && Decoder::DecodeAllAttributes() && !damaged_;
  }

  // Draco calls this for each attribute that is predicted over the mesh, after it has read the prediction
  // method and before the values. After a null result, Draco reads the values as if by another method.
  const draco::MeshAttributeIndicesEncodingData* GetAttributeEncodingData(int attribute) const override {
    const auto* data = Decoder::GetAttributeEncodingData(attribute);
    if (!data || !attributes_) return data;
    const int method = attributes_->data_head()[-2];
    const bool portable = method == draco::MESH_PREDICTION_TEX_COORDS_PORTABLE;
    if (!portable && method != draco::MESH_PREDICTION_TEX_COORDS_DEPRECATED) return data;
    const draco::Mesh& mesh = *this->mesh();
    if (orientations_within(uint64_t{3} * mesh.num_faces(), *attributes_,
                            portable || this->bitstream_version() < DRACO_BITSTREAM_VERSION(2, 2),
                            static_cast<uint32_t>(data->num_values),
                            mesh.attribute(attribute)->num_components()))
      return data;
    damaged_ = true;
    return nullptr;
  }

 private:
  bool take(uint64_t values) {
    values_ += values;
    return !exceeded();
  }

  uint64_t most_;
  uint64_t values_ = 0;
  const draco::DecoderBuffer* attributes_ = nullptr;
  mutable bool damaged_ = false;
};

// Steps over the tree of names and values that may stand before a mesh, and checks its size. Draco keeps a
// list of the branches to come, and trusts the length that the data claims at each level. A branch has at
// least three bytes.
class MetadataCheck {
 public:
  explicit MetadataCheck(draco::DecoderBuffer buffer) : buffer_(buffer) {}

  bool sound() {
    uint32_t attributes = 0;
    if (!count(attributes)) return false;
    for (uint32_t i = 0, id = 0; i < attributes; ++i)
      if (!count(id) || !tree()) return false;
    return tree();
  }

 private:
  bool tree() {
    uint64_t pending = 0;
    if (!values(pending)) return false;
    for (; pending > 0; --pending)
      if (!name() || !values(pending)) return false;
    return true;
  }

  bool values(uint64_t& pending) {
    uint32_t entries = 0;
    uint32_t branches = 0;
    if (!count(entries)) return false;
    for (uint32_t i = 0, size = 0; i < entries; ++i)
      if (!name() || !count(size) || !skip(size)) return false;
    if (!count(branches)) return false;
    pending += branches;
    return pending <= left();
  }

  bool name() {
    uint8_t length = 0;
    return buffer_.Decode(&length) && skip(length);
  }
  bool count(uint32_t& value) { return draco::DecodeVarint(&value, &buffer_); }
  bool skip(uint32_t bytes) {
    if (bytes > left()) return false;
    buffer_.Advance(bytes);
    return true;
  }
  uint64_t left() const { return static_cast<uint64_t>(buffer_.remaining_size()); }

  draco::DecoderBuffer buffer_;
};

template <typename Decoder>
DracoResult decode(draco::DecoderBuffer buffer, uint64_t most_values) {
  BoundedDecoder<Decoder> decoder(most_values);
  const auto mesh = std::make_shared<draco::Mesh>();
  const draco::Status status = decoder.Decode(draco::DecoderOptions(), &buffer, mesh.get());
  if (decoder.exceeded())
    return {nullptr, "have more faces or vertices than data of this size can encode", 0};
  if (!status.ok()) return {nullptr, fmt::format("are damaged: {}", status.error_msg()), 0};
  return {mesh, "", decoder.values()};
}

}  // namespace

DracoResult decode_draco(std::string_view data, uint64_t most_values) {
  draco::DecoderBuffer buffer;
  buffer.Init(data.data(), data.size());
  draco::DecoderBuffer head = buffer;
  draco::DracoHeader header;
  if (!draco::PointCloudDecoder::DecodeHeader(&head, &header).ok()) return {nullptr, "are not Draco data", 0};
  if (header.encoder_type != draco::TRIANGULAR_MESH) return {nullptr, "are not a mesh", 0};
  if ((header.flags & METADATA_FLAG_MASK) && !MetadataCheck(head).sound())
    return {nullptr, "are damaged: their metadata end too early", 0};
  try {
    if (header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING)
      return decode<draco::MeshEdgebreakerDecoder>(buffer, most_values);
    if (header.encoder_method == draco::MESH_SEQUENTIAL_ENCODING)
      return decode<draco::MeshSequentialDecoder>(buffer, most_values);
  } catch (const std::exception&) {  // thrown by the standard library's containers
    return {nullptr, "are damaged: they need more memory than there is", 0};
  }
  return {nullptr, "are of a kind that eyeray does not support", 0};
}

}  // namespace eyeray::engine::importers
