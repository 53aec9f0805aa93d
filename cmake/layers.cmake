# Our own code: warnings are errors, floats are never contracted, sanitizers as asked for.
add_library(eyeray_warnings INTERFACE)
target_compile_options(eyeray_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wdouble-promotion -Wnon-virtual-dtor
  -Werror -ffp-contract=off)
target_include_directories(eyeray_warnings INTERFACE ${CMAKE_SOURCE_DIR})
if(EYERAY_SANITIZE)
  add_compile_options(-fsanitize=${EYERAY_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${EYERAY_SANITIZE})
endif()
if(EYERAY_FUZZ)
  add_compile_options(-fsanitize=fuzzer-no-link)  # coverage for the fuzzers in everything
endif()

# eyeray_layer(NAME [COMPUTES] LINK …): the static library of every host/NAME/*.cpp. With sanitizers in the code, optimising takes a
# compiler longer than all else it does, and pays only for layers that compute, and for fuzzers.
function(eyeray_layer name)
  cmake_parse_arguments(arg "COMPUTES" "" "LINK" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/host/${name}/*.cpp)
  add_library(${name} STATIC ${sources})
  target_link_libraries(${name} PRIVATE eyeray_warnings)
  target_link_libraries(${name} ${arg_LINK})
  set_property(GLOBAL APPEND PROPERTY EYERAY_LAYERS ${name})
  if(EYERAY_SANITIZE AND NOT EYERAY_FUZZ AND NOT arg_COMPUTES)
    target_compile_options(${name} PRIVATE -O0)
  endif()
endfunction()
