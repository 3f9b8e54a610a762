# What `cmake --install` brings, and `cpack -G DEB` packs. The program itself tells completion, manual and schema.
include(GNUInstallDirs)
set(said ${PROJECT_BINARY_DIR}/said)
file(MAKE_DIRECTORY ${said})
add_custom_command(TARGET slagflow POST_BUILD
  COMMAND slagflow help --completion > ${said}/slagflow
  COMMAND slagflow help --man > ${said}/slagflow.1
  COMMAND slagflow help --schema > ${said}/slagflow.schema.json)

install(TARGETS slagflow)
install(DIRECTORY cases DESTINATION ${CMAKE_INSTALL_DATADIR}/slagflow FILES_MATCHING PATTERN *.toml PATTERN *.stl PATTERN *.csv)
install(FILES ${said}/slagflow.schema.json DESTINATION ${CMAKE_INSTALL_DATADIR}/slagflow)
install(FILES ${said}/slagflow DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
install(FILES ${said}/slagflow.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME slagflow)
set(CPACK_PACKAGE_CONTACT "the owner of slagflow <slagflow@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Free-surface flow of fluids with a yield stress by smoothed particles")
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_STRIP_FILES ON)
include(CPack)
