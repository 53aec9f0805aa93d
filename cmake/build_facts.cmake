# build_facts.cpp: what --version and --help print of the build. Written anew when the HEAD of the clone moves; no other file is compiled then.
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
add_custom_command(OUTPUT ${facts} DEPENDS ${head} ${script} COMMENT "Writing build_facts.cpp" VERBATIM
  COMMAND ${CMAKE_COMMAND} -D GIT=${GIT_EXECUTABLE} -D SOURCE=${CMAKE_SOURCE_DIR} -D INSTALLED=${installed} -D TREE=${tree} -D OUTPUT=${facts} -P ${script})
target_sources(eyeray PRIVATE ${facts})

install(FILES README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program FILES_MATCHING PATTERN "*.md" PATTERN experiments EXCLUDE)
install(DIRECTORY scenes DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
