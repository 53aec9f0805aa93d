#include "host/session/part_file.hpp"

#include "host/build/build_facts.hpp"
#include "host/scene/integrator.hpp"
#include "host/session/identity.hpp"

namespace eyeray::engine::session {
namespace {

shards::PartHeader header_of(const Plan& plan, const std::string& scene) {
  shards::PartHeader header;
  header.shard = *plan.request.shard;
  header.scene = scene;
  header.area = plan.crop;
  header.samples = plan.scene.image.samples;
  header.tone = plan.tone;
  header.transparent = plan.transparent();
  header.clamp = plan.request.clamp;
  header.random_paths = walks_at_random(plan.scene.render.integrator);
  header.device = plan.executor.facts().description;
  header.build = build::sum_of_sources();
  header.aovs = plan.channels;
  header.identity = identity_of_part(plan);
  return header;
}

shards::PartTotals totals_of(const Result& result, const film::ChannelValues& values) {
  shards::PartTotals totals;
  totals.rays = result.totals.rays;
  totals.flagged_pixels = result.totals.flagged_pixels;
  totals.flagged_hits = result.flagged_hits;
  totals.flags = result.quality.flags;
  totals.clamped = result.totals.clamped;
  totals.brightness = result.totals.brightness;
  totals.ray_kinds = result.ray_kinds;
  totals.seconds = result.totals.seconds;
  totals.processor_seconds = result.totals.processor_seconds;
  for (const film::Channel each : values.channels()) {
    const film::Legend* const legend = values.legend(each);
    totals.legends.push_back(legend ? legend->tally() : film::LegendTally());
  }
  return totals;
}

}  // namespace

void PartFile::begin(const Plan& plan) {
  channels_ = plan.channels;
  part_.emplace(file_, header_of(plan, scene_), *plan.tiles);
}

void PartFile::write(size_t plane, const image::Image& rows) {
  if (plane == 0 || channels_[plane - 1]->of_samples())
    part_->write(plane, rows);
  else
    part_->write_tile(plane, rows);
}

void PartFile::finish(const film::ChannelValues& values, Result& result) {
  if (result.interrupted()) return;
  part_->finish(totals_of(result, values));
  result.files.emplace_back(file_);
}

}  // namespace eyeray::engine::session
