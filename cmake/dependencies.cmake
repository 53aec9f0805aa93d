# Every dependency is a package of Debian, 12's or 13's; nothing is vendored. A line eyeray_needs…(PACKAGE …) names the package that holds it:
# scripts/setup installs the packages that these lines name. All missing packages are reported at once, by their names.

# eyeray_needs(PACKAGE NAME): CMake's package NAME.
macro(eyeray_needs package name)
  find_package(${name} QUIET)
  if(NOT ${name}_FOUND)
    list(APPEND missing_packages ${package})
  endif()
endmacro()

# eyeray_needs_module(PACKAGE NAME): pkg-config's module NAME, as the target PkgConfig::NAME.
macro(eyeray_needs_module package name)
  if(PkgConfig_FOUND)
    pkg_check_modules(${name} QUIET IMPORTED_TARGET ${name})
  endif()
  if(NOT ${name}_FOUND)
    list(APPEND missing_packages ${package})
  endif()
endmacro()

# eyeray_needs_file(PACKAGE VARIABLE FILE): the folder of a header, as VARIABLE.
macro(eyeray_needs_file package variable file)
  find_path(${variable} ${file})
  if(NOT ${variable})
    list(APPEND missing_packages ${package})
  endif()
endmacro()

# eyeray_needs_program(PACKAGE NAME): the path of a program, as NAME.
macro(eyeray_needs_program package name)
  find_program(${name} ${name})
  if(NOT ${name})
    list(APPEND missing_packages ${package})
  endif()
endmacro()

# Ends the configuration with an error if anything was missing so far.
macro(eyeray_has_needs)
  if(missing_packages)
    list(JOIN missing_packages " " missing_packages)
    message(FATAL_ERROR "eyeray needs the libraries of these Debian packages: ${missing_packages}. On Debian and Ubuntu, scripts/setup test installs them; "
      "docs/install.md says how to build on other systems.")
  endif()
endmacro()

find_package(Threads REQUIRED)
eyeray_needs(libfmt-dev fmt)
eyeray_needs(libglm-dev glm)
eyeray_needs(libtbb-dev TBB)
eyeray_needs(libtomlplusplus-dev tomlplusplus)
eyeray_needs(nlohmann-json3-dev nlohmann_json)
eyeray_needs(libcli11-dev CLI11)
eyeray_needs(libembree-dev embree)  # 3 or 4
eyeray_needs(libpng-dev PNG)
eyeray_needs(libtiff-dev TIFF)
eyeray_needs(zlib1g-dev ZLIB)
eyeray_needs(libfreetype-dev Freetype)
eyeray_needs(libopenexr-dev OpenEXR)
eyeray_needs(libdraco-dev draco)
eyeray_needs(libmeshoptimizer-dev meshoptimizer)
eyeray_needs(libvulkan-dev VulkanHeaders)
# The CMake files of glslang-dev end the configuration if this program is missing, although that package does not depend on it.
eyeray_needs_program(glslang-tools glslangValidator)
if(glslangValidator)
  eyeray_needs(glslang-dev glslang)
endif()
eyeray_needs(spirv-headers SPIRV-Headers)
eyeray_needs(spirv-tools SPIRV-Tools)
eyeray_needs(spirv-tools SPIRV-Tools-opt)
eyeray_needs(pkg-config PkgConfig)
eyeray_needs_module(libstb-dev stb)
eyeray_needs_module(libwebp-dev libwebp)
eyeray_needs_module(libminizip-dev minizip)
eyeray_needs_module(libexpat1-dev expat)
eyeray_needs_module(libmicrohttpd-dev libmicrohttpd)
eyeray_needs_file(libtinyobjloader-dev TINYOBJ_INCLUDE tiny_obj_loader.h)
eyeray_needs_file(libvulkan-volk-dev VOLK_INCLUDE volk.c)
eyeray_has_needs()

add_library(stb ALIAS PkgConfig::stb)
add_library(webp ALIAS PkgConfig::libwebp)
add_library(minizip ALIAS PkgConfig::minizip)
add_library(expat ALIAS PkgConfig::expat)
add_library(microhttpd ALIAS PkgConfig::libmicrohttpd)

# A header with its implementation, compiled into the importers.
add_library(tinyobjloader INTERFACE)
target_include_directories(tinyobjloader SYSTEM INTERFACE ${TINYOBJ_INCLUDE})

# volk ships as source: one translation unit that loads Vulkan at run time, so that eyeray starts without a loader.
add_library(volk INTERFACE)
target_include_directories(volk SYSTEM INTERFACE ${VOLK_INCLUDE})
target_compile_definitions(volk INTERFACE VK_NO_PROTOTYPES)
target_link_libraries(volk INTERFACE Vulkan::Headers ${CMAKE_DL_LIBS})

add_library(glslang_compiler INTERFACE)
target_link_libraries(glslang_compiler INTERFACE SPIRV-Headers::SPIRV-Headers glslang::glslang glslang::SPIRV glslang::glslang-default-resource-limits)
target_compile_options(glslang_compiler INTERFACE -fno-sanitize=vptr)  # Debian builds glslang without RTTI
add_library(spirv_tools INTERFACE)
target_link_libraries(spirv_tools INTERFACE SPIRV-Tools-opt SPIRV-Tools-static)
