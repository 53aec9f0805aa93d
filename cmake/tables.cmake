# Tables that take a second to compute, and are the same for every scene, are computed while eyeray is built.
function(eyeray_tables layer)
  add_executable(make_tables ${CMAKE_SOURCE_DIR}/cmake/tables.cpp)
  target_link_libraries(make_tables PRIVATE optics eyeray_warnings)
  set(out ${CMAKE_CURRENT_BINARY_DIR}/table_numbers.cpp)
  add_custom_command(OUTPUT ${out} COMMAND make_tables ${out} DEPENDS make_tables COMMENT "Computing tables" VERBATIM)
  target_sources(${layer} PRIVATE ${out})
endfunction()
