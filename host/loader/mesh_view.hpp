// The overrides that choose how a mesh file alone is shown: "look=clay", "camera=front". Private to the
// loader.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "host/core/diagnostic_log.hpp"
#include "host/importers/import.hpp"
#include "host/loader/scene_file.hpp"

namespace eyeray::engine::loader {

struct MeshChoices {
  std::optional<MeshLook> look;  // empty: that which suits the integrator
  int turntable = 0;             // frames of a full turn; 0: the model does not turn
  importers::ImportOptions reading;
  std::optional<Override> camera;
};

// Takes these overrides out of the list; the last of each key counts. Error (bad_input) for a wrong value.
MeshChoices take_mesh_choices(std::vector<Override>& overrides);

// Error (bad_input) if there is such an override, for `file` is a scene.
void refuse_mesh_choices(std::span<const Override> overrides, const std::filesystem::path& file);

// Removes all cameras but the one that `choice` names, or else the first. Several cameras may have one name;
// then the first with it is meant. A number counts cameras from 0, if none has that name. Warns of a choice
// that was not made. Error (bad_input) if there is no such camera, InputError if it is faulty.
void choose_camera(std::vector<importers::ImportedCamera>& cameras, const std::optional<Override>& choice,
                   const std::filesystem::path& file, DiagnosticLog& log);

}  // namespace eyeray::engine::loader
