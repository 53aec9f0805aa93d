# eyeray for other programs: a shared library whose only symbols are those of its header, so that its dependencies (glslang, toml++, TBB's
# templates …) do not clash with the program's own. `find_package(eyeray)` finds the installed library (docs/library.md).
configure_file(include/eyeray/version.hpp.in ${GENERATED}/include/eyeray/version.hpp @ONLY)
target_include_directories(library PUBLIC ${CMAKE_SOURCE_DIR}/include ${GENERATED}/include)
if(NOT EYERAY_LIBRARY)
  return()
endif()

# Until 1.0 any minor version may break programs, so SOVERSION contains it.
set(soversion ${PROJECT_VERSION_MAJOR})
if(soversion EQUAL 0)
  set(soversion 0.${PROJECT_VERSION_MINOR})
endif()
add_library(libeyeray SHARED $<TARGET_OBJECTS:library>)
add_library(eyeray::eyeray ALIAS libeyeray)
set(exported ${CMAKE_SOURCE_DIR}/cmake/library.map)
set_target_properties(libeyeray PROPERTIES OUTPUT_NAME eyeray EXPORT_NAME eyeray LINKER_LANGUAGE CXX
  VERSION ${PROJECT_VERSION} SOVERSION ${soversion} LINK_DEPENDS ${exported})
target_link_options(libeyeray PRIVATE -Wl,--version-script=${exported} -Wl,--no-undefined -Wl,--as-needed)
target_link_libraries(libeyeray PRIVATE library)
target_compile_features(libeyeray INTERFACE cxx_std_20)
target_include_directories(libeyeray INTERFACE $<BUILD_INTERFACE:${CMAKE_SOURCE_DIR}/include> $<BUILD_INTERFACE:${GENERATED}/include>
  $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)

include(CMakePackageConfigHelpers)
set(config ${CMAKE_INSTALL_LIBDIR}/cmake/eyeray)
configure_file(cmake/eyerayConfig.cmake.in ${CMAKE_BINARY_DIR}/eyerayConfig.cmake @ONLY)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/eyerayConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(TARGETS libeyeray EXPORT eyeray
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library NAMELINK_COMPONENT development)
install(EXPORT eyeray NAMESPACE eyeray:: FILE eyerayTargets.cmake DESTINATION ${config} COMPONENT development)
install(FILES ${CMAKE_BINARY_DIR}/eyerayConfig.cmake ${CMAKE_BINARY_DIR}/eyerayConfigVersion.cmake DESTINATION ${config}
  COMPONENT development)
install(FILES include/eyeray/eyeray.hpp ${GENERATED}/include/eyeray/version.hpp DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/eyeray
  COMPONENT development)
