# posidonia_add_library(obs [SHARED] SOURCES a.cpp b.cpp DEPENDS ... [PRIVATE_DEPENDS ...])
#   -> target posidonia_obs, alias posidonia::obs, headers under include/posidonia/obs/
# posidonia_add_app(auv-sim SOURCES auv-sim_main.cpp DEPENDS ...)
# posidonia_add_test(obs SOURCES test_a.cpp DEPENDS ... [SHARDS 2]) -> one test program a library, one ctest entry a
#   test; with SHARDS so many entries in all, for tests that share a fixture which is dear to make

add_library(posidonia_build_flags INTERFACE)
target_compile_features(posidonia_build_flags INTERFACE cxx_std_17)
# -ffp-contract=off: the same bytes whatever the optimiser fuses. GCC 12 gives false
# positives of -Wmaybe-uninitialized and -Warray-bounds inside Eigen at -O3.
target_compile_options(posidonia_build_flags INTERFACE
	-Wall -Wextra -Wconversion -Wno-sign-conversion -Wno-maybe-uninitialized -Wno-array-bounds
	-ffp-contract=off -fopenmp-simd)  # (only `#pragma omp simd`, no threads)
if(POSIDONIA_WARNINGS_AS_ERRORS)
	target_compile_options(posidonia_build_flags INTERFACE -Werror)
endif()
if(POSIDONIA_SANITIZE)
	target_compile_options(posidonia_build_flags INTERFACE
		-fsanitize=${POSIDONIA_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=undefined)
	target_link_options(posidonia_build_flags INTERFACE -fsanitize=${POSIDONIA_SANITIZE})
endif()

set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)

function(posidonia_add_library name)
	cmake_parse_arguments(ARG "SHARED" "" "SOURCES;DEPENDS;PRIVATE_DEPENDS" ${ARGN})
	set(kind STATIC)
	if(ARG_SHARED)
		set(kind SHARED)
	endif()
	add_library(posidonia_${name} ${kind} ${ARG_SOURCES})
	add_library(posidonia::${name} ALIAS posidonia_${name})
	set_target_properties(posidonia_${name} PROPERTIES OUTPUT_NAME posidonia-${name} CXX_EXTENSIONS OFF)
	target_include_directories(posidonia_${name} PUBLIC
		$<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:include>)
	target_link_libraries(posidonia_${name}
		PUBLIC ${ARG_DEPENDS}
		PRIVATE ${ARG_PRIVATE_DEPENDS} $<BUILD_INTERFACE:posidonia_build_flags>)
endfunction()

function(posidonia_add_app name)
	cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS" ${ARGN})
	add_executable(${name} ${ARG_SOURCES})
	set_target_properties(${name} PROPERTIES CXX_EXTENSIONS OFF)
	target_link_libraries(${name} PRIVATE ${ARG_DEPENDS} posidonia_build_flags)
endfunction()

function(posidonia_add_test name)
	cmake_parse_arguments(ARG "" "SHARDS" "SOURCES;DEPENDS" ${ARGN})
	add_executable(test_${name} ${ARG_SOURCES})
	set_target_properties(test_${name} PROPERTIES CXX_EXTENSIONS OFF)
	target_link_libraries(test_${name} PRIVATE ${ARG_DEPENDS} GTest::gtest GTest::gtest_main posidonia_build_flags)
	target_compile_definitions(test_${name} PRIVATE
		POSIDONIA_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
		POSIDONIA_BIN_DIR="${CMAKE_RUNTIME_OUTPUT_DIRECTORY}"
		POSIDONIA_LIB_DIR="${CMAKE_LIBRARY_OUTPUT_DIRECTORY}")
	target_include_directories(test_${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests/support)
	include(GoogleTest)
	if(ARG_SHARDS)
		foreach(shard RANGE 1 ${ARG_SHARDS})
			math(EXPR index "${shard} - 1")
			add_test(NAME ${name}.shard${shard}of${ARG_SHARDS} COMMAND test_${name})
			set_tests_properties(${name}.shard${shard}of${ARG_SHARDS} PROPERTIES TIMEOUT 1800
				ENVIRONMENT "GTEST_TOTAL_SHARDS=${ARG_SHARDS};GTEST_SHARD_INDEX=${index}")
		endforeach()
		return()
	endif()
	gtest_discover_tests(test_${name} TEST_PREFIX "${name}." DISCOVERY_TIMEOUT 120 PROPERTIES TIMEOUT 600)
endfunction()
