// A share of a picture, as a part for eyeray merge.
#pragma once

#include <optional>
#include <string>

#include "host/session/output.hpp"
#include "host/shards/part_writer.hpp"

namespace eyeray::engine::session {

// Writes a part. The file appears only once it is complete; Error (file_io) if it cannot be written.
class PartFile final : public Output {
 public:
  // `file`: the part. `scene`: the scene's file, as the user named it.
  PartFile(std::string file, std::string scene) : file_(std::move(file)), scene_(std::move(scene)) {}

  std::vector<std::filesystem::path> files() const override { return {file_}; }
  void begin(const Plan& plan) override;
  void write(size_t plane, const image::Image& rows) override;
  void finish_color() override {}
  void finish(const film::ChannelValues& values, Result& result) override;

 private:
  std::string file_;
  std::string scene_;
  film::Channels channels_;
  std::optional<shards::PartWriter> part_;
};

}  // namespace eyeray::engine::session
