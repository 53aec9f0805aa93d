// The sphereflake: "balls" of Haines' Standard Procedural Databases (A Proposal for Standard Graphics
// Environments, IEEE CG&A 7(11), 1987; package 3.14, CC0). Each sphere bears nine of a third of its size.
#pragma once

#include <functional>
#include <string>

#include "host/generate/mesh_sink.hpp"

namespace eyeray::engine::generate {

// The largest size factor. Above it, every mesh of a sphereflake has more triangles than permitted.
inline constexpr int max_sphereflake = 8;

struct Ball {
  Vec3 center;
  double radius;
};

// (9ⁿ⁺¹ − 1) / 8: 10, 91, 820, 7381, 66430, … for n = 1, 2, …
uint64_t sphereflake_count(int size_factor);

// Every sphere, parents before children, depth first. Calculated with square roots alone, hence the same to
// the last bit on every machine.
void for_each_ball(int size_factor, const std::function<void(const Ball&)>& visit);

// The TOML of camera, lights, floor and materials, the last of which is "ball".
std::string sphereflake_stage();

// The spheres as TOML: one [[sphere]] with a batch, in the fewest digits that are exact.
std::string sphereflake_spheres(int size_factor);

// The spheres as one mesh: octahedra whose edges are divided into `divisions`, pushed out to the sphere:
// 8 · divisions² triangles for each sphere.
void sphereflake_mesh(int size_factor, int divisions, MeshSink& sink);

// The divisions with which the mesh comes nearest to `triangles`, at least 1.
int sphereflake_divisions(int size_factor, uint64_t triangles);
uint64_t sphereflake_triangles(int size_factor, int divisions);

}  // namespace eyeray::engine::generate
