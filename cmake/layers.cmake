# Options for our own code: warnings are errors, floats are never contracted, and EYERAY_SANITIZE chooses sanitizers.
add_library(eyeray_warnings INTERFACE)
target_compile_options(eyeray_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wdouble-promotion -Wnon-virtual-dtor
  -Werror -ffp-contract=off)
target_include_directories(eyeray_warnings INTERFACE ${CMAKE_SOURCE_DIR})
# GCC collects its garbage often. If it may use some more memory, it takes a tenth less time.
target_compile_options(eyeray_warnings INTERFACE
  $<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-expand=400> $<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=262144>)
if(EYERAY_SANITIZE)
  add_compile_options(-fsanitize=${EYERAY_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${EYERAY_SANITIZE})
endif()
if(EYERAY_FUZZ)
  add_compile_options(-fsanitize=fuzzer-no-link)  # coverage for the fuzzers in everything
endif()

# Headers that most files include are parsed once for each set of options, in the builds of .ci/run. tests/architecture checks that a file includes
# the ones of these headers whose names it uses. eyeray_precompiled(TARGET [OPTIONS -O0 …] [NAME … HEADERS … LINK …]): a target's own options, what its
# files include beside, the libraries that have it, and a name for these headers. A header with many templates costs each file that includes it a second,
# precompiled or not: it belongs to the files alone that use it.
function(eyeray_precompiled target)
  if(NOT EYERAY_PRECOMPILED)
    return()
  endif()
  cmake_parse_arguments(arg "" "NAME" "OPTIONS;HEADERS;LINK" ${ARGN})
  string(REPLACE ";" "" owner "headers${arg_NAME}${arg_OPTIONS}")
  if(NOT TARGET ${owner})
    file(CONFIGURE OUTPUT ${owner}.cpp CONTENT "")
    add_library(${owner} OBJECT ${CMAKE_CURRENT_BINARY_DIR}/${owner}.cpp)
    if(CMAKE_CXX_COMPILER_ID STREQUAL Clang)  # by where files lie: nothing for ccache to give to another clone
      set_target_properties(${owner} PROPERTIES CXX_COMPILER_LAUNCHER "")
    endif()
    target_link_libraries(${owner} PRIVATE eyeray_warnings fmt::fmt glm::glm ${arg_LINK})
    target_compile_options(${owner} PRIVATE ${arg_OPTIONS})
    target_precompile_headers(${owner} PRIVATE <algorithm> <array> <atomic> <cmath> <filesystem> <fstream> <functional> <map> <memory>
      <optional> <set> <span> <string> <string_view> <variant> <vector> <fmt/format.h> <fmt/ranges.h> <glm/glm.hpp> ${arg_HEADERS})
  endif()
  target_precompile_headers(${target} REUSE_FROM ${owner})
  get_target_property(type ${target} TYPE)
  if(type STREQUAL EXECUTABLE AND CMAKE_POSITION_INDEPENDENT_CODE)  # as what it reuses: CMake gives executables -fPIE
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE OFF)
    target_compile_options(${target} PRIVATE -fPIC)
  endif()
endfunction()

# Headers take most of a compiler's time, so eight files are compiled at a time, in the same builds: names in anonymous namespaces may
# not be the same in two files of a target. Files of a kind (a shape, a material, a generator, …) are compiled alone: all kinds have the
# same names, such as `manual`, `keys`, `parse` and `scene`. (CMake's own UNITY_BUILD names files by where they lie, so that no other
# clone would find in ccache what this one compiled.)
function(eyeray_in_batches target)
  if(NOT EYERAY_PRECOMPILED)
    return()
  endif()
  get_target_property(all ${target} SOURCES)
  list(FILTER all INCLUDE REGEX "^${CMAKE_CURRENT_SOURCE_DIR}/.*\\.cpp$")
  list(FILTER all EXCLUDE REGEX "^${CMAKE_BINARY_DIR}/")  # generated files do not exist yet
  set(sources "")
  foreach(source IN LISTS all)
    file(STRINGS ${source} kind REGEX "^constexpr std::string_view manual =|^std::string scene[(]" LIMIT_COUNT 1)
    if(NOT kind)
      list(APPEND sources ${source})
    endif()
  endforeach()
  set_source_files_properties(${sources} PROPERTIES HEADER_FILE_ONLY ON)
  set(number 0)
  while(sources)
    list(SUBLIST sources 0 8 batch)
    list(REMOVE_ITEM sources ${batch})
    set(text "")
    foreach(source IN LISTS batch)
      cmake_path(RELATIVE_PATH source BASE_DIRECTORY ${CMAKE_SOURCE_DIR})
      string(APPEND text "#include \"${source}\"\n")
    endforeach()
    set(file ${CMAKE_CURRENT_BINARY_DIR}/batches/${target}_${number}.cpp)
    file(CONFIGURE OUTPUT ${file} CONTENT "${text}")
    target_sources(${target} PRIVATE ${file})
    math(EXPR number "${number} + 1")
  endwhile()
endfunction()

# How our own files are compiled. Optimising takes compilers most of their time. With sanitizers in the code it pays only for layers that compute, and
# for fuzzers. It pays little for what serves: programs, and layers that read and write some text for each picture.
function(eyeray_compiled target speed link)
  set(options "")
  if(EYERAY_SANITIZE AND NOT EYERAY_FUZZ AND NOT speed STREQUAL COMPUTES)
    set(options -O0)
  elseif(speed STREQUAL SERVES AND NOT EYERAY_SANITIZE AND NOT CMAKE_BUILD_TYPE STREQUAL Debug)
    set(options -O1)
  endif()
  target_link_libraries(${target} PRIVATE eyeray_warnings)
  target_compile_options(${target} PRIVATE ${options})
  set(json "")
  if(speed STREQUAL SERVES OR "nlohmann_json::nlohmann_json" IN_LIST link)
    set(json NAME -json HEADERS <nlohmann/json.hpp> LINK nlohmann_json::nlohmann_json)
  endif()
  eyeray_precompiled(${target} OPTIONS ${options} ${json})
  eyeray_in_batches(${target})
endfunction()

# eyeray_layer(NAME [COMPUTES | SERVES] LINK …): the static library of every *.cpp in host/NAME, or in benchmarks/NAME.
function(eyeray_layer name)
  cmake_parse_arguments(arg "COMPUTES;SERVES" "" "LINK" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/host/${name}/*.cpp ${CMAKE_SOURCE_DIR}/benchmarks/${name}/*.cpp)
  add_library(${name} STATIC ${sources})
  target_link_libraries(${name} ${arg_LINK})
  set(speed "")
  foreach(keyword COMPUTES SERVES)
    if(arg_${keyword})
      set(speed ${keyword})
    endif()
  endforeach()
  eyeray_compiled(${name} "${speed}" "${arg_LINK}")
  set_property(GLOBAL APPEND PROPERTY EYERAY_LAYERS ${name})
endfunction()

# eyeray_program(NAME FOLDER): the program of every *.cpp in host/FOLDER, or in benchmarks/FOLDER.
function(eyeray_program name folder)
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/host/${folder}/*.cpp ${CMAKE_SOURCE_DIR}/benchmarks/${folder}/*.cpp)
  add_executable(${name} ${sources})
  eyeray_compiled(${name} SERVES "")
endfunction()
