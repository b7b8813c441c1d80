# `cpack` makes a Debian package: program, libraries, Python module, man page and completions.
set(documents ${PROJECT_BINARY_DIR}/documents)
add_custom_command(OUTPUT ${documents}/trivalent.1.gz ${documents}/trivalent.bash ${documents}/_trivalent
  COMMAND ${TRIVALENT_PYTHON} ${PROJECT_SOURCE_DIR}/scripts/packaging/manual.py $<TARGET_FILE:trivalent> ${documents}
  COMMAND gzip -9nf ${documents}/trivalent.1
  DEPENDS trivalent ${PROJECT_SOURCE_DIR}/scripts/packaging/manual.py
  COMMENT "Making the man page and the completions" VERBATIM)
add_custom_target(trivalent_documents ALL DEPENDS ${documents}/trivalent.1.gz)
install(FILES ${documents}/trivalent.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES ${documents}/trivalent.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME trivalent)
install(FILES ${documents}/_trivalent DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright)
install(FILES CITATION.cff README.md DESTINATION ${CMAKE_INSTALL_DOCDIR})

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGE_CONTACT "The Trivalent developers")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# numpy and the fonts of pictures are found by no linker.
set(CPACK_DEBIAN_PACKAGE_DEPENDS "python3 (>= 3.11), python3 (<< 3.12), python3-numpy, fonts-dejavu-core")
# Only for those who compile against the libraries, run LAMMPS, or use ASE.
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "python3-ase, python3-tqdm, lammps, lammps-data, libopenmesh-dev, libcgal-dev, libeigen3-dev, \
libtbb-dev, zlib1g-dev, libpugixml-dev, libmuparser-dev, liblz4-dev, libcairo2-dev, libsymspg-dev, libboost-filesystem-dev, nlohmann-json3-dev")
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/scripts/packaging/postinst
  ${PROJECT_SOURCE_DIR}/scripts/packaging/prerm)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "turns any surface into sp2 carbon")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
 "A shape goes in (a mesh file, arrays, or a built-in one); a net of carbon that
follows it comes out, with an energy for every atom, relaxed, checked, and
ready for molecular dynamics: a program, C++ libraries and a Python module.")
include(CPack)
