# build_facts.cpp: the facts about the build that --version and --help print. It is written anew if the clone's HEAD moves; no other file is compiled then.
# It is also written anew if a source changes: checkpoints and parts identify the program by a sum of the sources, the compiler and its flags.
find_package(Git QUIET)
set(head "")
if(GIT_FOUND)
  execute_process(COMMAND ${GIT_EXECUTABLE} rev-parse --git-path logs/HEAD WORKING_DIRECTORY ${CMAKE_SOURCE_DIR}
    OUTPUT_VARIABLE head OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  cmake_path(ABSOLUTE_PATH head BASE_DIRECTORY ${CMAKE_SOURCE_DIR})
  if(NOT EXISTS "${head}")
    set(head "")
  endif()
endif()
# The folder of README.md, docs/ and scenes/, as the program finds it: where it is installed, and where it is built.
file(RELATIVE_PATH installed ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_DOCDIR})
file(RELATIVE_PATH tree ${CMAKE_BINARY_DIR} ${CMAKE_SOURCE_DIR})
set(facts ${CMAKE_BINARY_DIR}/generated/build_facts.cpp)
set(script ${CMAKE_SOURCE_DIR}/cmake/write_build_facts.cmake)
include(cmake/program_sources.cmake)
program_sources(sources ${CMAKE_SOURCE_DIR})
list(TRANSFORM sources PREPEND ${CMAKE_SOURCE_DIR}/)
string(TOUPPER "${CMAKE_BUILD_TYPE}" type)
set(compiler "${CMAKE_SYSTEM_PROCESSOR} ${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION} ${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${type}} ${EYERAY_SANITIZE}")
add_custom_command(OUTPUT ${facts} DEPENDS ${head} ${sources} COMMENT "Writing build_facts.cpp" VERBATIM
  COMMAND ${CMAKE_COMMAND} -D GIT=${GIT_EXECUTABLE} -D SOURCE=${CMAKE_SOURCE_DIR} -D COMPILER=${compiler} -D INSTALLED=${installed} -D TREE=${tree} -D VERSION=${PROJECT_VERSION} -D OUTPUT=${facts} -P ${script})
target_sources(build PRIVATE ${facts})

install(FILES README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program FILES_MATCHING PATTERN "*.md" PATTERN experiments EXCLUDE)
install(DIRECTORY scenes DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
