# import eyeray (docs/python.md): a module over the library, and the package around it. In the build folder it lies under python/.
if(NOT EYERAY_PYTHON OR NOT EYERAY_LIBRARY)
  return()
endif()
find_package(pybind11 REQUIRED CONFIG)

set(package ${CMAKE_BINARY_DIR}/python/eyeray)
file(GLOB texts CONFIGURE_DEPENDS RELATIVE ${CMAKE_SOURCE_DIR}/python/eyeray python/eyeray/*.py python/eyeray/*.pyi
  python/eyeray/py.typed)
foreach(text IN LISTS texts)
  configure_file(python/eyeray/${text} ${package}/${text} COPYONLY)
endforeach()

file(GLOB sources CONFIGURE_DEPENDS python/*.cpp)
pybind11_add_module(eyeray_python MODULE NO_EXTRAS ${sources})
target_link_libraries(eyeray_python PRIVATE eyeray::eyeray eyeray_warnings)
target_compile_options(eyeray_python PRIVATE -O1)  # a compiler takes long over pybind11's templates, which hardly run
# lib/python3/dist-packages is where Debian's Python looks; the library is three folders above.
set(EYERAY_PYTHON_DIR lib/python3/dist-packages CACHE STRING "Where the Python package is installed")
set_target_properties(eyeray_python PROPERTIES OUTPUT_NAME _eyeray LIBRARY_OUTPUT_DIRECTORY ${package}
  INSTALL_RPATH "$ORIGIN/../../..")
install(TARGETS eyeray_python LIBRARY DESTINATION ${EYERAY_PYTHON_DIR}/eyeray COMPONENT python)
list(TRANSFORM texts PREPEND python/eyeray/)
install(FILES ${texts} DESTINATION ${EYERAY_PYTHON_DIR}/eyeray COMPONENT python)
