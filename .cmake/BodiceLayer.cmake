# How bodice declares a layer and installs what was declared.

# bodice_layer(<name> USES <layers...> [PRIVATE <targets...>])
# Declares the static library bodice::<name> from <name>/src/**.cpp. It exports
# only its own include folder and those of the layers it uses; PRIVATE packages
# are invisible to its users.
function(bodice_layer name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "DIR" "USES;PRIVATE")
  if(NOT arg_DIR)
    set(arg_DIR "${CMAKE_CURRENT_SOURCE_DIR}/${name}")
  endif()
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS "${arg_DIR}/src/*.cpp")
  set(target bodice_${name})
  add_library(${target} STATIC ${sources})
  add_library(bodice::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES
    EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden
    VISIBILITY_INLINES_HIDDEN ON)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_include_directories(${target}
    PUBLIC $<BUILD_INTERFACE:${arg_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
    PRIVATE "${arg_DIR}/src")
  foreach(layer IN LISTS arg_USES)
    target_link_libraries(${target} PUBLIC bodice_${layer})
  endforeach()
  target_link_libraries(${target} PRIVATE ${arg_PRIVATE} $<BUILD_INTERFACE:bodice_build_flags>)
  set_property(GLOBAL APPEND PROPERTY BODICE_LAYERS ${name})
  set_property(GLOBAL PROPERTY BODICE_LAYER_${name}_USES ${arg_USES})
  set_property(GLOBAL PROPERTY BODICE_LAYER_${name}_DIR ${arg_DIR})
endfunction()

# Installs every layer and a package file, so that find_package(bodice) gives bodice::<layer>.
function(bodice_install_layers)
  include(CMakePackageConfigHelpers)
  set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/bodice")
  get_property(layers GLOBAL PROPERTY BODICE_LAYERS)
  foreach(layer IN LISTS layers)
    get_property(dir GLOBAL PROPERTY BODICE_LAYER_${layer}_DIR)
    install(TARGETS bodice_${layer} EXPORT bodice-targets ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}")
    install(DIRECTORY "${dir}/include/" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
  endforeach()
  install(TARGETS bodice_cli RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
  install(EXPORT bodice-targets NAMESPACE bodice:: DESTINATION "${package_dir}")
  configure_package_config_file("${PROJECT_SOURCE_DIR}/.cmake/bodice-config.cmake.in"
    "${PROJECT_BINARY_DIR}/bodice-config.cmake" INSTALL_DESTINATION "${package_dir}")
  write_basic_package_version_file("${PROJECT_BINARY_DIR}/bodice-config-version.cmake"
    COMPATIBILITY SameMinorVersion)
  install(FILES "${PROJECT_BINARY_DIR}/bodice-config.cmake" "${PROJECT_BINARY_DIR}/bodice-config-version.cmake"
    DESTINATION "${package_dir}")
endfunction()
