# `eyeray verify` as tests: gates A, B and C on every scene file (ctest -L scene), in every mode (ctest -L mode) and under the
# validation layers (ctest -L validation). The files of a failing gate are in the build folder.
file(GLOB_RECURSE SCENES CONFIGURE_DEPENDS RELATIVE ${CMAKE_SOURCE_DIR} ${CMAKE_SOURCE_DIR}/scenes/*.toml)
list(FILTER SCENES EXCLUDE REGEX "/include/")
# Scenes of path tracing have many samples a pixel: a few samples show two executors' agreement as well.
set(PATHS ${SCENES})
list(FILTER PATHS INCLUDE REGEX "^scenes/path/")
list(REMOVE_ITEM SCENES ${PATHS})
# The kernels of these scenes take seconds to compile.
set(SHOWCASE ${SCENES})
list(FILTER SHOWCASE INCLUDE REGEX "^scenes/(showcase/|gallery|five_ways)")
list(REMOVE_ITEM SCENES ${SHOWCASE})
set(SHAPE_SCENES ${SCENES})
list(FILTER SHAPE_SCENES INCLUDE REGEX "^scenes/shapes/")
# The gallery has the shapes of the other scenes, in one kernel that takes seconds to compile. The Mandelbulb takes seconds to trace. One run of each is enough.
list(FILTER SHAPE_SCENES EXCLUDE REGEX "/(gallery|mandelbulb)")

# eyeray_verify(NAME LABEL [QUICK|STAND_IN|NIGHTLY] ARGUMENT …): one process for all its scenes. QUICK: it is in what `scripts/test` alone
# runs. STAND_IN: there alone, since a longer test has the same kernels and gates at more pixels. NIGHTLY: in `scripts/test --nightly` alone.
function(eyeray_verify name label)
  cmake_parse_arguments(arg "QUICK;STAND_IN;NIGHTLY" "" "" ${ARGN})
  if(arg_STAND_IN)
    list(APPEND label stand-in)
  elseif(arg_NIGHTLY)
    list(APPEND label nightly)
  elseif(NOT arg_QUICK)
    list(APPEND label full)
  endif()
  add_test(NAME ${name} COMMAND eyeray verify ${arg_UNPARSED_ARGUMENTS} --quiet --timeout 3600
    --keep ${CMAKE_CURRENT_BINARY_DIR}/kept/${name}
    WORKING_DIRECTORY ${CMAKE_SOURCE_DIR})
  set_tests_properties(${name} PROPERTIES LABELS "${label}" TIMEOUT 3600)
endfunction()

# eyeray_mode(NAME SCENES OPTION …): of the list of that name one scene in 24, other ones in each mode; the rest each night.
set(mode_share 24)
set(mode_starts 12)
set(mode_first 0)
function(eyeray_mode name scenes)
  set(some "")
  set(others ${${scenes}})
  list(LENGTH others count)
  math(EXPR last "${count} - 1")
  foreach(i RANGE ${mode_first} ${last} ${mode_share})
    list(GET ${scenes} ${i} scene)
    list(APPEND some ${scene})
  endforeach()
  list(REMOVE_ITEM others ${some})
  eyeray_verify(mode.${name} mode ${some} ${ARGN})
  eyeray_verify(mode.${name}.others mode NIGHTLY ${others} ${ARGN})
  math(EXPR next "(${mode_first} + 1) % ${mode_starts}")
  set(mode_first ${next} PARENT_SCOPE)
endfunction()

# Every scene, small; but for the edge scenes, which have one size, and the slowest: each of those is a test below. Formulas take seconds to
# compile, and are the same in any mode.
set(EDGES ${SCENES})
list(FILTER EDGES INCLUDE REGEX "^scenes/edges/")
list(FILTER EDGES EXCLUDE REGEX "/(formulas|intervals|sheet|coarse_glass|tight_bound)")
set(quick ${SCENES})
list(FILTER quick EXCLUDE REGEX "^scenes/edges/|/(gallery|group_shapes|mandelbulb|sculpture|shapes/csg|shapes/implicit)")
eyeray_verify(scenes.small scene QUICK ${quick} -s 48x36)
eyeray_verify(scenes.edges scene QUICK ${EDGES})

# Scenes as their files define them: those that are not above and every twelfth other one with `--full`, all each night. Three take a minute or
# two, so that `--full` verifies their kernels in modes alone.
set(number 0)
foreach(scene IN LISTS SCENES)
  string(REGEX REPLACE "^scenes/(.*)\\.toml$" "\\1" name ${scene})
  string(REPLACE "/" "." name ${name})
  math(EXPR of_twelve "${number} % 12")
  set(when NIGHTLY)
  if(NOT scene MATCHES "/(mandelbulb|sculpture|sphere_sweep)" AND (of_twelve EQUAL 0 OR NOT scene IN_LIST quick AND NOT scene IN_LIST EDGES))
    set(when "")
  endif()
  eyeray_verify(scene.${name} scene ${when} ${scene})
  math(EXPR number "${number} + 1")
endforeach()

# Ways of finding hits that small pictures would not use.
set(by_bvh --tune acceleration=bvh --tune constants=off)
set(by_packets ${by_bvh} --tune rays=packets)

# Scenes of path tracing, traced in every way and with every sampler.
set(few_samples -s 96x72 --spp 4)
eyeray_verify(scenes.paths scene QUICK ${PATHS} ${few_samples})
eyeray_verify(scenes.paths.large scene NIGHTLY ${PATHS} -s 320x240 --spp 4)
eyeray_verify(scenes.showcase scene ${SHOWCASE} -s 96x64 --spp 4)
eyeray_mode(paths.packets PATHS ${few_samples} ${by_packets})
eyeray_mode(paths.cooperative PATHS ${few_samples} --tune acceleration=bvh --tune rays=packets --tune incoherent=cooperative)
eyeray_mode(paths.random PATHS ${few_samples} --seed 7 -D image.pattern=random)
eyeray_mode(paths.jittered PATHS ${few_samples} --seed 7 -D image.pattern=jittered)

# Photons in every scene that has a light and a surface for them; tests/loader/refused_by_sppm.txt has the others, and why, and
# tests/loader/photons.cpp holds each to that. Scenes that take long to compile or to trace run only at night.
file(STRINGS ${CMAKE_SOURCE_DIR}/tests/loader/refused_by_sppm.txt refused)
list(FILTER refused INCLUDE REGEX "^scenes/")
list(TRANSFORM refused REPLACE " .*" "")
set(GATHERED ${SCENES} ${PATHS} ${SHOWCASE})
# Photons are aimed at twisted's glass, whose pieces touch. 9 % of them diverge by which of two pieces is hit first. All are explained, but
# only 4 % may diverge.
list(REMOVE_ITEM GATHERED ${refused} scenes/edges/twisted.toml)
set(gathered_long ${GATHERED})
list(FILTER gathered_long INCLUDE REGEX "/(showcase|gallery|forest|group_shapes|mandelbulb|sculpture|intervals|sheet|formulas|implicit|algebraic|csg)")
list(REMOVE_ITEM GATHERED ${gathered_long})
set(photons -s 24x18 --spp 1 --integrator sppm -D render.photons=4096 --tune constants=off --max-explained 0.05)
eyeray_mode(photons GATHERED ${photons})
eyeray_verify(mode.photons.long mode NIGHTLY ${gathered_long} ${photons})

# Filters whose samples also lie outside their pixels.
foreach(filter IN ITEMS gaussian blackman-harris)
  eyeray_verify(mode.filter.${filter} mode scenes/whitted.toml scenes/cameras/fisheye.toml scenes/path/lamps.toml -s 96x72 --spp 4 -D image.filter=${filter})
endforeach()

# Every mode, on small pictures. The edge scenes put whole rows of pixels where the picture jumps, for one size and one sample.
set(small ${SCENES})
list(FILTER small EXCLUDE REGEX "^scenes/edges/|/gallery|/group_shapes|/forest|/shapes/(algebraic|bezier|implicit|mandelbulb|sculpture|csg)")
# Modes that no shape's code knows of need no scene for each shape.
set(views ${small})
list(FILTER views EXCLUDE REGEX "^scenes/shapes/")
# Scenes whose kernels take seconds to make have fewer modes.
set(slow scenes/shapes/algebraic.toml scenes/shapes/bezier.toml scenes/shapes/csg.toml -s 96x72)
eyeray_verify(mode.slow-kernels.packets mode ${slow} scenes/shapes/implicit.toml scenes/shapes/mandelbulb.toml scenes/shapes/sculpture.toml scenes/forest.toml
  ${by_packets})
set(jittered --spp 4 -D image.pattern=jittered --seed 7 --max-explained 0.02)
eyeray_verify(mode.slow-kernels.jittered mode scenes/shapes/implicit.toml scenes/shapes/sculpture.toml scenes/forest.toml -s 96x72 ${jittered})
# A march takes up to 4096 steps a ray. For 64 rays of glass in a row that is more than Mesa 22.3.6 allows, which is reported (docs/lavapipe.md).
set(deep --max-depth 64 -D render.min_throughput=0.01)
eyeray_verify(mode.slow-kernels.deep-jittered mode ${slow} ${deep} ${jittered})
# Without constants, many modes share kernels, which are compiled once.
eyeray_mode(no-constants small -s 96x72 --tune constants=off)
eyeray_verify(mode.no-constants.edges mode QUICK ${EDGES} --tune constants=off)
# Every way of finding hits finds the same hits. The GPU's profile runs on any device.
set(searched scenes/meshes.toml scenes/sphereflake.toml scenes/cornell.toml scenes/inside_glass.toml -s 96x72)
eyeray_verify(mode.no-optimiser mode ${searched} --tune optimiser=off)
# All that kernels survive of what Vulkan allows.
set(worst -s 48x36 --spp 1 --tune constants=off --tune device-division=worst --tune device-contraction=worst --tune device-nan=worst)
eyeray_verify(mode.worst-device mode scenes/whitted.toml scenes/textures.toml scenes/meshes.toml scenes/path/cornell_box.toml ${worst})
eyeray_verify(mode.worst-device.all mode NIGHTLY ${SCENES} ${PATHS} ${worst})
set(groups scenes/group_instances.toml scenes/group_shapes.toml)
eyeray_verify(mode.groups-once mode QUICK scenes/groups.toml scenes/group_instances.toml -s 96x72 -D render.groups=instanced)
eyeray_verify(mode.groups-copied mode ${groups} scenes/forest.toml -s 96x72 -D render.groups=flat)
eyeray_mode(bvh small -s 96x72 ${by_bvh})
set(few scenes/cornell.toml scenes/inside_glass.toml scenes/meshes.toml scenes/group_instances.toml -s 48x36)
eyeray_verify(mode.packets.few mode STAND_IN ${few} ${by_packets})
eyeray_verify(mode.profile-gpu.few mode STAND_IN ${few} --tune profile=gpu)
eyeray_mode(bvh.edges EDGES ${by_bvh})
eyeray_verify(mode.brute-force mode ${searched} --tune acceleration=brute-force)
# Without a BVH a ray hits each triangle as often as it is shown: more rays in a row, or patches, are more loops than Mesa 22.3.6 grants.
eyeray_verify(mode.brute-force.groups mode scenes/group_instances.toml -s 48x36 --tune acceleration=brute-force --max-depth 0)
eyeray_verify(mode.splits mode ${searched} ${groups} --tune acceleration=bvh --tune splits=on)
set(profiled ${views} scenes/shapes/polygon.toml scenes/shapes/torus.toml scenes/edges/twisted.toml)
eyeray_mode(profile-gpu profiled -s 96x72 --tune profile=gpu)
eyeray_mode(packets small -s 96x72 ${by_packets})
set(bounces scenes/sphereflake.toml scenes/cornell.toml scenes/textures.toml)
eyeray_verify(mode.cooperative mode QUICK ${bounces} -s 48x36 ${by_packets} --tune incoherent=cooperative)
eyeray_mode(packets.edges EDGES ${by_packets})
# Vectors as wide as for big pictures, if the processor has them.
eyeray_verify(mode.wide-vectors mode ${few} scenes/shapes/torus.toml scenes/shapes/csg.toml)
set_tests_properties(mode.wide-vectors PROPERTIES ENVIRONMENT LP_NATIVE_VECTOR_WIDTH=512)
# By the emulator: gates A and S. Each night with subgroups as wide as those of GPUs, too.
set(emulated --backends twin,emulator)
eyeray_verify(mode.emulated mode QUICK scenes/whitted.toml scenes/cornell.toml scenes/textures.toml scenes/meshes.toml scenes/groups.toml
  scenes/shapes/text.toml scenes/bumps.toml scenes/shapes/torus.toml scenes/shapes/csg.toml scenes/edges/tiny.toml -s 32x24 ${emulated})
eyeray_verify(mode.emulated.paths mode QUICK scenes/path/cornell_box.toml scenes/sppm/box.toml -s 32x24 --spp 1 ${emulated})
eyeray_verify(mode.emulated.packets mode QUICK scenes/sphereflake.toml -s 32x24 ${emulated} ${by_packets})
eyeray_verify(mode.emulated.cooperative mode scenes/path/cornell_box.toml -s 32x24 --spp 1 ${emulated} ${by_packets} --tune incoherent=cooperative)
eyeray_verify(mode.emulated.all mode NIGHTLY ${SCENES} -s 32x24 --max-explained 0.05 ${emulated})
eyeray_verify(mode.emulated.paths.all mode NIGHTLY ${PATHS} ${SHOWCASE} -s 32x24 --spp 1 --max-explained 0.05 ${emulated})
foreach(size IN ITEMS 4 16 32 64)
  eyeray_verify(mode.emulated.subgroups-${size} mode NIGHTLY ${bounces} -s 32x24 --spp 1 --max-explained 0.05 ${emulated}
    --tune acceleration=bvh --tune constants=off --tune incoherent=cooperative --tune subgroup=${size})
endforeach()
eyeray_mode(raycast small -s 96x72 --integrator raycast)
eyeray_mode(raycast.edges EDGES --integrator raycast)
eyeray_mode(eye-rays views -s 96x72 --max-depth 0)
eyeray_mode(deep small -s 96x72 --tune constants=off ${deep})
eyeray_verify(mode.moller-trumbore mode scenes/cornell.toml scenes/whitted.toml scenes/shapes/triangle.toml -s 96x72
  --triangle moller-trumbore)
# A pixel of n samples is n times as likely to have a sample at a jump.
eyeray_mode(supersampled views -s 96x72 --spp 4 --max-explained 0.02)
eyeray_mode(jittered small -s 96x72 --tune constants=off --spp 9 -D image.pattern=jittered --seed 7 --max-explained 0.02)

set(some scenes/cornell.toml scenes/inside_glass.toml scenes/orthographic.toml)
# Gate R, where there is a projection matrix; in the forest it takes half a minute.
set(drawn ${small} ${EDGES})
list(FILTER drawn EXCLUDE REGEX "^scenes/cameras/")
eyeray_mode(raster drawn -s 96x72 --raster --backends gpu --integrator raycast)
# Cylinders as triangles that are a hundredth of a pixel wide.
eyeray_verify(mode.raster.slivers mode QUICK scenes/shapes/cylinder.toml -s 160x79 --raster --backends gpu)
eyeray_verify(validation.raster validation ${some} -s 96x72 --raster --backends gpu --validate core)
# Scenes of Whitted's integrator, rendered by path tracing.
eyeray_mode(paths.whitted small -s 48x36 --spp 2 --tune constants=off --integrator path --max-explained 0.05)

# Pictures whose sizes are no multiples of a workgroup's, and parts of pictures.
foreach(size 1x1 7x3 1x300 300x1 17x33)
  eyeray_verify(mode.size-${size} mode QUICK ${some} -s ${size})
endforeach()
# Rays that start beyond another face of the same glass box (docs/rounding.md).
eyeray_verify(mode.contact mode scenes/shapes/box.toml -s 640x427 --crop 476,250,24,24)
# Sizes that put a row or a column of pixels onto an edge, or one beside a caustic's rim (docs/report.md, causes: undecidable). What the
# kernels make is the twin's, bit by bit, at any size: those that take seconds to make are left out.
foreach(size 126x63 160x79)
  eyeray_verify(mode.edge-row-${size} mode scenes/edges/grazing.toml -s ${size})
endforeach()
eyeray_verify(mode.edge-on mode QUICK scenes/edges/continued.toml -s 160x79 --backends twin)
eyeray_verify(mode.plane-of-a-rim mode QUICK scenes/edges/continued.toml -s 126x63 --backends twin)
eyeray_verify(mode.edge-row-horizon mode scenes/shapes/algebraic.toml -s 110x73 --crop 0,0,110,6 --backends twin)
eyeray_verify(mode.caustic-rim mode scenes/shapes/gallery.toml -s 96x72 --crop 75,38,9,9 --backends twin)
eyeray_verify(mode.caustic-rim-wide mode scenes/shapes/gallery.toml -s 96x54 --crop 75,29,9,9 --backends twin)
eyeray_verify(mode.plane-of-symmetry mode scenes/whitted.toml -s 333x250 --crop 162,69,9,9)
eyeray_verify(mode.plane-of-symmetry-walls mode scenes/whitted.toml -s 309x231 --crop 154,163,1,1 --backends twin)
# Rays that skim a formula's surface, leave it beside a ridge, strike a flake, skim where rounding grows, and leave the wall of a gyroid
# (docs/numerics.md, affine bounds).
eyeray_verify(mode.skimmed-formula mode QUICK scenes/shapes/mandelbulb.toml -s 160x79 --crop 40,33,12,32 --backends twin)
eyeray_verify(mode.clamped-formula mode QUICK scenes/shapes/mandelbulb.toml -s 333x250 --crop 134,159,11,11 --backends twin)
eyeray_verify(mode.flaky-formula mode QUICK scenes/shapes/mandelbulb.toml -s 270x180 --crop 121,71,9,9 --backends twin)
eyeray_verify(mode.rounding-formula mode QUICK scenes/shapes/mandelbulb.toml -s 270x180 --crop 192,52,1,1 --backends twin)
eyeray_verify(mode.skimmed-gyroid mode QUICK scenes/shapes/sculpture.toml -s 333x250 --crop 63,243,1,1 --backends twin)
eyeray_verify(mode.empty-csg mode tests/loader/warned/empty_csg.toml)
eyeray_verify(mode.unlit mode QUICK tests/loader/warned/unlit.toml)
eyeray_verify(mode.crop mode QUICK ${some} -s 200x150 --crop 51,37,83,71)
eyeray_verify(mode.crop-jittered mode ${some} -s 200x150 --crop 199,0,1,150 --spp 4 -D image.pattern=jittered)

# No seed may cause a false alarm; scripts/false-alarms tests more cases.
set(of_seed -s 48x36 --spp 4 -D image.pattern=jittered --max-explained 0.02 --backends twin)
eyeray_verify(mode.seed-1 mode ${quick} ${EDGES} ${of_seed} --seed 1)
foreach(seed 2 3)
  eyeray_verify(mode.seed-${seed} mode NIGHTLY ${quick} ${EDGES} ${of_seed} --seed ${seed})
endforeach()

# A second driver with its own compiler: SwiftShader (docs/lavapipe.md, another driver), within 8 GiB. No test takes 60 s of processor time; how
# long that is depends on what else the machine does.
set(SWIFTSHADER /usr/lib/chromium/vk_swiftshader_icd.json CACHE FILEPATH "The manifest of the driver that the label `driver` asks")
set(driver ${SCENES})
list(FILTER driver INCLUDE REGEX "^scenes/shapes/")
# eyeray_driver(NAME COMMAND…): runs a command with only that driver.
function(eyeray_driver name)
  add_test(NAME driver.${name} COMMAND prlimit --as=8589934592 $<TARGET_FILE:eyeray> ${ARGN} WORKING_DIRECTORY ${CMAKE_SOURCE_DIR})
  set_tests_properties(driver.${name} PROPERTIES LABELS "driver;full" TIMEOUT 600
    ENVIRONMENT "VK_DRIVER_FILES=${SWIFTSHADER};VK_ICD_FILENAMES=${SWIFTSHADER}")
endfunction()
foreach(scene IN LISTS driver ITEMS scenes/whitted.toml scenes/cornell.toml scenes/sphereflake.toml)
  get_filename_component(name ${scene} NAME_WE)
  eyeray_driver(${name} verify ${scene} -s 24x18 --quiet --timeout 600)
endforeach()
# That driver's profile, on any device.
eyeray_verify(mode.profile-small mode QUICK ${few} --tune profile=small)

# Every message of a validation layer is a failure; tests/gpu proves that the layers are there and speak. `core` reads the kernels too,
# `sync` what is around them. A part of a scene at its own size has the kernels that were made for all of it.
set(set scenes/whitted.toml ${some} -s 96x72)
eyeray_verify(validation.core validation scenes/whitted.toml ${some} ${SHAPE_SCENES} --crop 100,60,96,72 --validate core)
eyeray_verify(validation.core.no-constants validation ${set} --validate core --tune constants=off)
eyeray_verify(validation.core.no-constants.shapes validation NIGHTLY ${SHAPE_SCENES} -s 96x72 --validate core --tune constants=off)
eyeray_verify(validation.sync validation QUICK ${set} --validate sync)
eyeray_verify(validation.sync.no-constants validation ${set} --validate sync --tune constants=off)

# Mutants of the shaders, three that gates B and C detect (docs/proving-the-proof.md, mutants).
add_test(NAME mutate COMMAND python3 scripts/mutate --files math/rng.glsl --count 3 --jobs 1 --least 1 --eyeray $<TARGET_FILE:eyeray>
  WORKING_DIRECTORY ${CMAKE_SOURCE_DIR})
set_tests_properties(mode.packets mode.slow-kernels.packets mode.jittered scene.shapes.mandelbulb scene.shapes.sculpture PROPERTIES COST 40)
set_tests_properties(mutate PROPERTIES LABELS "scene;nightly" TIMEOUT 3600)
