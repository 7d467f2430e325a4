# find_package(Plumbline): the libraries behind the commands (Plumbline::api, Plumbline::fit, Plumbline::model ...), their
# headers, and how a controller is built. cmake --install BUILD --component development --prefix DIR
include(CMakePackageConfigHelpers)
set(package lib/cmake/Plumbline)
set(PLUMBLINE_HAS_MPI FALSE)
if(TARGET MPI::MPI_C)
  set(PLUMBLINE_HAS_MPI TRUE)
endif()

# The project's libraries that a target needs, itself among them, into the global property plumbline_exported.
function(plumbline_collect target)
  get_property(known GLOBAL PROPERTY plumbline_exported)
  if(target IN_LIST known)
    return()
  endif()
  set_property(GLOBAL APPEND PROPERTY plumbline_exported ${target})
  get_target_property(needs ${target} LINK_LIBRARIES)
  foreach(need IN LISTS needs)
    if(need MATCHES "^plumbline_")
      plumbline_collect(${need})
    endif()
  endforeach()
endfunction()

plumbline_collect(plumbline_api)
get_property(exported GLOBAL PROPERTY plumbline_exported)
foreach(library IN LISTS exported)
  string(REGEX REPLACE "^plumbline_" "" name ${library})
  set_target_properties(${library} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(${library} INTERFACE $<INSTALL_INTERFACE:include/plumbline>)
  target_compile_features(${library} INTERFACE $<INSTALL_INTERFACE:cxx_std_17>)
  # Of the two copies of SUNDIALS in a program each keeps its names to itself (PlumblineTargets.cmake).
  target_link_options(${library} INTERFACE $<INSTALL_INTERFACE:-Wl,--exclude-libs,ALL>)
  install(TARGETS ${library} EXPORT PlumblineLibraries ARCHIVE DESTINATION lib/plumbline COMPONENT development)
endforeach()
install(EXPORT PlumblineLibraries NAMESPACE Plumbline:: DESTINATION ${package} COMPONENT development)

# The headers of their folders; the driver's program has none of its own to offer.
set(headers)
foreach(library IN LISTS exported)
  get_target_property(folder ${library} SOURCE_DIR)
  file(GLOB_RECURSE found CONFIGURE_DEPENDS RELATIVE ${CMAKE_SOURCE_DIR} ${folder}/*.h)
  list(APPEND headers ${found})
endforeach()
list(REMOVE_DUPLICATES headers)
list(FILTER headers EXCLUDE REGEX "^controllers/driver/")
foreach(header IN LISTS headers)
  get_filename_component(folder ${header} DIRECTORY)
  install(FILES ${header} DESTINATION include/plumbline/${folder} COMPONENT development)
endforeach()

install(DIRECTORY examples DESTINATION share/plumbline COMPONENT development)

configure_package_config_file(cmake/PlumblineConfig.cmake.in PlumblineConfig.cmake INSTALL_DESTINATION ${package})
# Before 1.0 a minor version may change anything.
write_basic_package_version_file(PlumblineConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/PlumblineConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/PlumblineConfigVersion.cmake
        cmake/PlumblineDependencies.cmake cmake/PlumblineController.cmake controllers/controller.map
        DESTINATION ${package} COMPONENT development)
