# Man pages and completions, which the program generates from its options.
set(manual ${CMAKE_BINARY_DIR}/manual)
add_custom_command(OUTPUT ${manual}/man1/eyeray.1 ${manual}/eyeray.bash ${manual}/_eyeray ${manual}/eyeray.fish
  COMMAND eyeray manual ${manual}/man1
  COMMAND eyeray completion bash > ${manual}/eyeray.bash
  COMMAND eyeray completion zsh > ${manual}/_eyeray
  COMMAND eyeray completion fish > ${manual}/eyeray.fish
  DEPENDS eyeray COMMENT "Writing man pages" VERBATIM)
add_custom_target(manual ALL DEPENDS ${manual}/man1/eyeray.1)
install(DIRECTORY ${manual}/man1 DESTINATION ${CMAKE_INSTALL_MANDIR} COMPONENT program)
install(FILES ${manual}/eyeray.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME eyeray COMPONENT program)
install(FILES ${manual}/_eyeray DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions COMPONENT program)
install(FILES ${manual}/eyeray.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d COMPONENT program)
