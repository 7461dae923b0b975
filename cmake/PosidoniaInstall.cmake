# cmake --install, find_package(posidonia) for others, and cpack's Debian package.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# ---------------------------------------------------------------------------------------------- libraries, programs
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/posidonia)
foreach(lib ${POSIDONIA_LIBRARIES})
	set_target_properties(posidonia_${lib} PROPERTIES EXPORT_NAME ${lib})
	install(TARGETS posidonia_${lib} EXPORT posidonia
		ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
	install(DIRECTORY libs/${lib}/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
endforeach()
set_target_properties(posidonia_amd PROPERTIES EXPORT_NAME amd)
install(TARGETS posidonia_amd EXPORT posidonia)
install(EXPORT posidonia NAMESPACE posidonia:: FILE posidonia-targets.cmake DESTINATION ${package_dir})
configure_package_config_file(cmake/posidonia-config.cmake.in ${PROJECT_BINARY_DIR}/posidonia-config.cmake
	INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/posidonia-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/posidonia-config.cmake ${PROJECT_BINARY_DIR}/posidonia-config-version.cmake
	DESTINATION ${package_dir})
set_target_properties(${POSIDONIA_APPS} PROPERTIES INSTALL_RPATH "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")
install(TARGETS ${POSIDONIA_APPS} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})

# ------------------------------------------------------------------------- experiments, documents, completion, manual
install(DIRECTORY ini DESTINATION ${CMAKE_INSTALL_DATADIR}/posidonia)
install(DIRECTORY docs examples DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES cmake/copyright DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES libs/report/web/dist/LICENSES.txt DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME report-page-licenses.txt)
foreach(app ${POSIDONIA_APPS})
	install(FILES cmake/auv-completion.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME ${app})
endforeach()

# Manual pages are what --help says: they can't go stale.
find_program(HELP2MAN help2man)
if(HELP2MAN)
	foreach(app ${POSIDONIA_APPS})
		set(page ${PROJECT_BINARY_DIR}/man/${app}.1)
		add_custom_command(OUTPUT ${page}
			COMMAND ${CMAKE_COMMAND} -E make_directory ${PROJECT_BINARY_DIR}/man
			COMMAND ${HELP2MAN} --no-info --name=${PROJECT_DESCRIPTION} --output=${page} $<TARGET_FILE:${app}>
			DEPENDS ${app} VERBATIM)
		list(APPEND pages ${page})
	endforeach()
	add_custom_target(man ALL DEPENDS ${pages})
	install(FILES ${pages} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
endif()

# --------------------------------------------------------------------------------------------------- Debian package
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_CONTACT "the Posidonia developers")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "stereo graph-SLAM for AUVs, on MRPT")
set(CPACK_PACKAGE_DESCRIPTION
	"Programs that navigate an underwater vehicle by looking at the sea floor: simulator, navigation filter, stereo graph-SLAM,
closed-loop missions, evaluation and reports. With the libraries that they are made of, for find_package(posidonia).")
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# What find_package(posidonia) asks for; the programs alone do without.
set(CPACK_DEBIAN_PACKAGE_SUGGESTS
	"libmrpt-graphslam-dev, libmrpt-bayes-dev, libmrpt-topography-dev, libmrpt-maps-dev, libeigen3-dev, libopencv-dev, libsuitesparse-dev, libembree-dev, nlohmann-json3-dev, libtclap-dev, zlib1g-dev")
include(CPack)
