# Every outside package that Posidonia uses, in one place (Debian 12 versions).
# MRPT's exported targets ask for optional packages (ZeroMQ, OpenNI ...) with REQUIRED OFF: harmless.
find_package(Eigen3 3.4 REQUIRED)
find_package(OpenCV 4.6 REQUIRED COMPONENTS core imgproc imgcodecs features2d calib3d)
foreach(component poses obs config math img io graphs graphslam bayes topography opengl maps system)
	find_package(mrpt-${component} 2.5 REQUIRED)
endforeach()
find_package(Threads REQUIRED)
find_package(embree 3.13 REQUIRED)  # ray tracing of the simulated floor
find_package(nlohmann_json 3.11 REQUIRED)

# SuiteSparse has no CMake package in Debian 12.
find_path(AMD_INCLUDE_DIR amd.h PATH_SUFFIXES suitesparse REQUIRED)
find_library(AMD_LIBRARY amd REQUIRED)
find_library(CAMD_LIBRARY camd REQUIRED)
add_library(posidonia_amd INTERFACE)
add_library(posidonia::amd ALIAS posidonia_amd)
target_include_directories(posidonia_amd SYSTEM INTERFACE ${AMD_INCLUDE_DIR})
target_link_libraries(posidonia_amd INTERFACE ${AMD_LIBRARY} ${CAMD_LIBRARY})

if(POSIDONIA_BUILD_TESTS)
	if(POSIDONIA_WITH_CHOLMOD)
		find_library(CHOLMOD_LIBRARY cholmod REQUIRED)	# test oracle only
		add_library(posidonia_cholmod INTERFACE)
		add_library(posidonia::cholmod ALIAS posidonia_cholmod)
		target_include_directories(posidonia_cholmod SYSTEM INTERFACE ${AMD_INCLUDE_DIR})
		target_link_libraries(posidonia_cholmod INTERFACE ${CHOLMOD_LIBRARY})
	endif()
	find_package(GTest REQUIRED)
	find_package(Ceres 2.1 REQUIRED)  # test oracle only
endif()
if(POSIDONIA_BUILD_BENCHMARKS)
	find_package(benchmark REQUIRED)
endif()

# Debian's TCLAP 1.2 (header only); MRPT bundles 1.1, which can't leave error handling to the program.
find_path(TCLAP_INCLUDE_DIR tclap/CmdLine.h REQUIRED)
