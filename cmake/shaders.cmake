# The shaders, twice: as C++ headers for the twin, and as text embedded in the binary.
set(SHADER_ROOT ${CMAKE_SOURCE_DIR}/shaders)
set(GENERATED ${CMAKE_BINARY_DIR}/generated)
file(GLOB_RECURSE SHADER_FILES CONFIGURE_DEPENDS RELATIVE ${SHADER_ROOT} ${SHADER_ROOT}/*.glsl ${SHADER_ROOT}/*.h)
list(TRANSFORM SHADER_FILES PREPEND ${SHADER_ROOT}/ OUTPUT_VARIABLE SHADER_PATHS)

# The twin compiles every row of the registries; a GPU kernel, its scene's only (executors/specialise.cpp).
foreach(registry cameras samplers textures shapes materials lights integrators)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${SHADER_ROOT}/${registry}/registry.h)
  file(STRINGS ${SHADER_ROOT}/${registry}/registry.h rows REGEX "^  (X\\(|R\\(X, )[a-z_]+,")
  string(REGEX REPLACE "  (X\\(|R\\(X, )([a-z_]+),[^;]*" "#include \"${registry}/\\2.glsl\"\n" includes "${rows}")
  string(REPLACE ";" "" includes "${includes}")
  file(CONFIGURE OUTPUT ${GENERATED}/${registry}/all.glsl CONTENT "${includes}")
endforeach()

add_library(shader_headers INTERFACE)
target_include_directories(shader_headers INTERFACE ${SHADER_ROOT} ${GENERATED})

set(EMBED ${CMAKE_SOURCE_DIR}/cmake/embed_shaders.cmake)
add_custom_command(
  OUTPUT ${GENERATED}/embedded_shaders.cpp
  COMMAND ${CMAKE_COMMAND} -D ROOT=${SHADER_ROOT} -D OUT=${GENERATED}/embedded_shaders.cpp "-D FILES=${SHADER_FILES}" -P ${EMBED}
  DEPENDS ${SHADER_PATHS} ${EMBED}
  COMMENT "Embedding the shaders" VERBATIM)
add_library(embedded_shaders STATIC ${GENERATED}/embedded_shaders.cpp)
target_link_libraries(embedded_shaders PRIVATE eyeray_warnings)
