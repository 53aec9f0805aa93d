# Everything comes from Debian's packages, 12's or 13's (scripts/setup); nothing is vendored.
find_package(fmt REQUIRED)
find_package(glm REQUIRED)
find_package(TBB REQUIRED)
find_package(tomlplusplus REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(embree REQUIRED)  # 3 or 4
find_package(Threads REQUIRED)
find_package(PNG REQUIRED)
find_package(ZLIB REQUIRED)
find_package(OpenEXR REQUIRED)
find_package(draco REQUIRED)
find_package(meshoptimizer REQUIRED)
find_package(VulkanHeaders REQUIRED)
find_package(glslang REQUIRED)
find_package(SPIRV-Headers REQUIRED)
find_package(SPIRV-Tools REQUIRED)
find_package(SPIRV-Tools-opt REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(stb REQUIRED IMPORTED_TARGET stb)
add_library(stb ALIAS PkgConfig::stb)
# Its types depend on how Debian compiled it, which its .pc file says.
pkg_check_modules(cpp-httplib REQUIRED IMPORTED_TARGET cpp-httplib)
add_library(httplib ALIAS PkgConfig::cpp-httplib)

# A header with its implementation, compiled into the importers.
find_path(TINYOBJ_INCLUDE tiny_obj_loader.h REQUIRED)
add_library(tinyobjloader INTERFACE)
target_include_directories(tinyobjloader SYSTEM INTERFACE ${TINYOBJ_INCLUDE})

# volk ships as source: one translation unit that loads Vulkan at run time, so that eyeray starts without a loader.
find_path(VOLK_INCLUDE volk.c REQUIRED)
add_library(volk INTERFACE)
target_include_directories(volk SYSTEM INTERFACE ${VOLK_INCLUDE})
target_compile_definitions(volk INTERFACE VK_NO_PROTOTYPES)
target_link_libraries(volk INTERFACE Vulkan::Headers ${CMAKE_DL_LIBS})

add_library(glslang_compiler INTERFACE)
target_link_libraries(glslang_compiler INTERFACE SPIRV-Headers::SPIRV-Headers glslang::glslang glslang::SPIRV glslang::glslang-default-resource-limits)
target_compile_options(glslang_compiler INTERFACE -fno-sanitize=vptr)  # Debian builds glslang without RTTI
add_library(spirv_tools INTERFACE)
target_link_libraries(spirv_tools INTERFACE SPIRV-Tools-opt SPIRV-Tools-static)
