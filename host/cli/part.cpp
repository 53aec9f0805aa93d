// eyeray render --shard: a scene becomes a part of a picture.
#include <optional>

#include "host/cli/identity.hpp"
#include "host/cli/prepared_picture.hpp"
#include "host/core/termination.hpp"
#include "host/film/values.hpp"
#include "host/program/build_facts.hpp"
#include "host/scene/integrator.hpp"
#include "host/shards/part_writer.hpp"

namespace eyeray::cli {
namespace {

shards::PartHeader header_of(const PictureRequest& request, const PreparedPicture& prepared) {
  const Scene& scene = prepared.scene;
  shards::PartHeader header;
  header.shard = *request.shard;
  header.scene = request.scene.file();
  header.area = prepared.crop;
  header.samples = scene.image.samples;
  header.tone = scene.image.tone;
  header.clamp = request.clamp;
  header.random_paths = walks_at_random(scene.render.integrator);
  header.device = prepared.executor->description();
  header.build = sum_of_sources();
  header.aovs = request.aovs;
  header.identity = identity_of_parts(request, scene, *prepared.executor);
  return header;
}

// What the rays through the centres of the tiles' pixels hit, tile by tile. Returns false when interrupted.
bool write_first_hits(const PreparedPicture& prepared, film::ChannelValues& values, shards::PartWriter& part,
                      Picture& picture) {
  std::vector<FirstHit> hits;
  for (const Rect& tile : prepared.tiles->tiles()) {
    hits.assign(size_t(tile.pixels()), {});
    prepared.executor->first_hits(tile, hits);
    // An interrupted executor leaves out what it likes.
    if (interrupted()) return false;
    for (const FirstHit& hit : hits) {
      picture.flags |= hit.flags;
      picture.flagged_hits += hit.flags != 0;
    }
    values.give(hits, tile.width,
                [&](size_t aov, const image::Image& rows) { part.write_tile(1 + aov, rows); });
  }
  return true;
}

}  // namespace

Picture make_part(PictureRequest request, const std::function<void(const render::Progress&)>& progress) {
  const Stopwatch watch;
  Picture picture;
  const auto prepared = prepare(request, picture.times, progress);
  const std::string& file = request.outputs[0];
  shards::PartWriter part(file, header_of(request, *prepared), *prepared->tiles);
  film::ChannelValues values(request.aovs, prepared->scene);
  StageTimes writing;
  render::RenderTotals totals;
  // Of more shards than tiles some have nothing to do.
  if (prepared->tiles->pixels() > 0)
    totals = render::render_rows(
        prepared->scene, *prepared->executor, prepared->options, [&](const film::Rows& rows) {
          writing.measure("write", [&] {
            part.write(0, rows.color);
            values.give(rows, [&](size_t aov, const image::Image& image) { part.write(1 + aov, image); });
          });
        });
  picture.interrupted = totals.interrupted;
  // Some of a pixel's samples are none of the picture's, which has all of them.
  if (picture.interrupted) totals.samples_done = 0;
  if (!picture.interrupted && film::any_of_first_hits(request.aovs))
    picture.interrupted = !write_first_hits(*prepared, values, part, picture);

  if (!picture.interrupted) {
    shards::PartTotals sums;
    sums.rays = totals.rays;
    sums.flagged_pixels = totals.flagged_pixels;
    sums.flagged_hits = picture.flagged_hits;
    sums.flags = totals.flags | picture.flags;
    sums.clamped = totals.clamped;
    sums.brightness = totals.brightness;
    // A checkpoint has none of them: what was counted before it is lost.
    const bool resumed = prepared->checkpoint && prepared->checkpoint->resumes();
    if (request.ray_kinds && !resumed) sums.ray_kinds = totals.ray_kinds;
    sums.seconds = totals.seconds;
    sums.processor_seconds = totals.processor_seconds;
    for (size_t i = 0; i < request.aovs.size(); ++i)
      sums.legends.push_back(values.legend(i) ? values.legend(i)->tally() : film::LegendTally());
    const Saving saving;
    writing.measure("write", [&] { part.finish(sums); });
    picture.files.emplace_back(file);
    if (prepared->checkpoint) prepared->checkpoint->remove();
  }

  describe(request, *prepared, totals, picture);
  picture.shard = request.shard;
  picture.pixels = prepared->tiles->pixels();
  for (const StageTimes& times : {prepared->executor->times(), writing})
    for (const auto& [stage, seconds] : times.stages()) picture.times.add(stage, seconds);
  picture.seconds = watch.seconds();
  return picture;
}

}  // namespace eyeray::cli
