# What `cmake --install` puts where, and the Debian package that `cpack` makes of it (in a build folder, preset `portable`).
# Programs go into bin/. Data and scripts keep the layout of the tree, under share/spall/, so that they find each other there
# as they do here; the scripts look for the programs in build/, which there holds links.
include(GNUInstallDirs)
set(spall_share ${CMAKE_INSTALL_DATADIR}/spall)

install(TARGETS microcell material_point penetrate RUNTIME)
install(PROGRAMS shared/spall TYPE BIN)
install(DIRECTORY data DESTINATION ${spall_share} PATTERN __pycache__ EXCLUDE)
install(DIRECTORY shared/compare shared/studies shared/empirical shared/strength shared/viewing DESTINATION ${spall_share}/shared
        FILES_MATCHING PATTERN *.py PATTERN *.html PATTERN *.css PATTERN *.js)
install(PROGRAMS shared/run shared/study shared/formulas shared/concrete shared/tension shared/view DESTINATION ${spall_share}/shared)
foreach(name spall penetrate microcell material_point) # bash looks for a file with the name of the command
  install(FILES shared/completion.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME ${name})
endforeach()
install(FILES README.md LICENSE CITATION.cff CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/spall)
foreach(program micro/microcell macro/material_point macro/penetrate)
  get_filename_component(name ${program} NAME)
  get_filename_component(room ${program} DIRECTORY)
  file(RELATIVE_PATH target /${spall_share}/build/${room} /${CMAKE_INSTALL_BINDIR}/${name})
  install(CODE "
    file(MAKE_DIRECTORY \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${spall_share}/build/${room}\")
    file(CREATE_LINK ${target} \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${spall_share}/build/${program}\" SYMBOLIC)")
endforeach()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME spall)
set(CPACK_PACKAGE_CONTACT "The Spall developers <spall@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON) # libraries that the programs are linked with
set(CPACK_DEBIAN_PACKAGE_DEPENDS
    "libjs-chart.js, openmpi-bin, python3, python3-h5py, python3-jinja2, python3-matplotlib, python3-meshio, python3-numpy, python3-pil")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "paraview, python3-paraview, xvfb") # of shared/view
include(CPack)
