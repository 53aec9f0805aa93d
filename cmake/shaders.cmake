# The shaders, twice: as C++ headers for the twin, and as text embedded in the binary.
set(SHADER_ROOT ${CMAKE_SOURCE_DIR}/shaders)
set(GENERATED ${CMAKE_BINARY_DIR}/generated)
file(GLOB_RECURSE SHADER_FILES CONFIGURE_DEPENDS RELATIVE ${SHADER_ROOT} ${SHADER_ROOT}/*.glsl ${SHADER_ROOT}/*.h)
list(TRANSFORM SHADER_FILES PREPEND ${SHADER_ROOT}/ OUTPUT_VARIABLE SHADER_PATHS)

# The twin compiles every row of the registries; a GPU kernel, its scene's only (executors/specialise.cpp).
set(REGISTRIES cameras samplers textures bsdf shapes materials lights emitters integrators)
foreach(registry IN LISTS REGISTRIES)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${SHADER_ROOT}/${registry}/rows.h)
  file(STRINGS ${SHADER_ROOT}/${registry}/rows.h rows REGEX "^  (X\\(|R\\(X, )[a-z_]+,")
  string(REGEX REPLACE "  (X\\(|R\\(X, )([a-z_]+),[^;]*" "#include \"${registry}/\\2.glsl\"\n" includes "${rows}")
  string(REPLACE ";" "" includes "${includes}")
  file(CONFIGURE OUTPUT ${GENERATED}/${registry}/all.glsl CONTENT "${includes}")
endforeach()

add_library(shader_headers INTERFACE)
target_include_directories(shader_headers INTERFACE ${SHADER_ROOT} ${GENERATED})

# The sources from which the twin of a user's shaders is compiled on request (executors/twin_module.cpp).
set(TWIN_NAMES host/twin/twin.cpp host/twin/shader_functions.hpp host/twin/scene_view.hpp host/twin/glsl_functions.hpp
  host/core/local_shaders.hpp host/records/records.hpp)
list(TRANSFORM TWIN_NAMES PREPEND ${CMAKE_SOURCE_DIR}/ OUTPUT_VARIABLE TWIN_PATHS)
foreach(registry IN LISTS REGISTRIES)
  list(APPEND TWIN_NAMES shaders/${registry}/all.glsl)
  list(APPEND TWIN_PATHS ${GENERATED}/${registry}/all.glsl)
endforeach()
get_target_property(glm_include glm::glm INTERFACE_INCLUDE_DIRECTORIES)
execute_process(
  COMMAND ${CMAKE_CXX_COMPILER} -std=c++20 -M -I${CMAKE_SOURCE_DIR} -I${glm_include} ${CMAKE_SOURCE_DIR}/host/twin/glsl_functions.hpp
  OUTPUT_VARIABLE included COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "[^ \n\\]+/glm/[^ \n\\]+" glm_paths "${included}")
foreach(path IN LISTS glm_paths)
  cmake_path(NORMAL_PATH path)  # Clang writes "glm/./ext/../detail/…"
  string(REGEX REPLACE ".*/glm/((detail/|simd/|ext/)?[^/]+)$" "glm/\\1" name ${path})
  if(NOT name IN_LIST TWIN_NAMES)
    list(APPEND TWIN_NAMES ${name})
    list(APPEND TWIN_PATHS ${path})
  endif()
endforeach()

add_library(embedded_shaders STATIC)
target_link_libraries(embedded_shaders PRIVATE eyeray_warnings)
eyeray_embed(embedded_shaders eyeray::engine::embedded_shaders "${SHADER_FILES}" "${SHADER_PATHS}")
eyeray_embed(embedded_shaders eyeray::engine::twin_sources "${TWIN_NAMES}" "${TWIN_PATHS}")
