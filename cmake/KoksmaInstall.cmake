# Install rules, for find_package(koksma): libraries, headers, the CMake functions, the program and its data.
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/koksma)
set(data_dir ${CMAKE_INSTALL_DATADIR}/koksma)

set(libraries sampling simd core integrators bench conformance rates)
list(TRANSFORM libraries PREPEND koksma_ OUTPUT_VARIABLE targets)
foreach(library IN LISTS libraries)
  set_target_properties(koksma_${library} PROPERTIES EXPORT_NAME ${library})
endforeach()
list(TRANSFORM KOKSMA_OWN_SAMPLERS PREPEND koksma_sampler_ OUTPUT_VARIABLE sampler_targets)
install(TARGETS ${targets} ${sampler_targets} koksma_sampler_files koksma_stb EXPORT koksmaTargets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(TARGETS koksma RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(EXPORT koksmaTargets NAMESPACE koksma:: DESTINATION ${package_dir})

install(DIRECTORY lib/include/koksma integrators/include/koksma bench/include/koksma checks/include/koksma
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(DIRECTORY samplers/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/koksma/samplers FILES_MATCHING PATTERN "*.h" PATTERN data EXCLUDE)

# What koksma_link_samplers() must know of each sampler.
set(koksma_samplers "")
foreach(name IN LISTS KOKSMA_OWN_SAMPLERS)
  get_target_property(type koksma_sampler_${name} KOKSMA_SAMPLER_TYPE)
  get_target_property(header koksma_sampler_${name} KOKSMA_SAMPLER_HEADER)
  get_filename_component(header ${header} NAME)
  string(APPEND koksma_samplers "koksma_found_sampler(${name} ${type} ${header})\n")
endforeach()
configure_package_config_file(cmake/koksmaConfig.cmake.in ${PROJECT_BINARY_DIR}/koksmaConfig.cmake INSTALL_DESTINATION ${package_dir}
                              PATH_VARS CMAKE_INSTALL_INCLUDEDIR data_dir)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/koksmaConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/koksmaConfig.cmake ${PROJECT_BINARY_DIR}/koksmaConfigVersion.cmake cmake/KoksmaTarget.cmake
        cmake/KoksmaSamplers.cmake cmake/KoksmaProgram.cmake cmake/KoksmaConformance.cmake cmake/conformance_main.cpp
        DESTINATION ${package_dir})

# The same places below share/koksma as in the source tree: experiments name their scenes by relative paths.
install(DIRECTORY scenes DESTINATION ${data_dir})
install(DIRECTORY bench/experiments bench/references bench/report DESTINATION ${data_dir}/bench OPTIONAL
        PATTERN __pycache__ EXCLUDE PATTERN tests EXCLUDE)
