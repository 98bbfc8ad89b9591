# How bodice declares a layer and installs what was declared.

# bodice_layer(<name> USES <layers...> PROMISES <headers...> | NOTHING
#              [PUBLIC <targets...>] [PRIVATE <targets...>] [HEADERS <targets...>] [FLAGS <options...>] [TOGETHER])
# Declares the static library bodice::<name> from <name>/src/**.cpp. It exports only its own include folder and
# those of the layers it uses. PROMISES are the headers in include/bodice/<name>, without .hpp, that users may rely
# on; these and the headers that they include are installed, and modules/README.md lists them. Packages: PUBLIC ones
# are in its headers, PRIVATE ones must be there to link it, and HEADERS ones only to compile it, so that users of an
# installed bodice need them not. FLAGS are compile options of the layer's own files. TOGETHER: all of them compile as
# one where folders do (bodice_unite).
function(bodice_layer name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "TOGETHER" "DIR" "USES;PROMISES;PUBLIC;PRIVATE;HEADERS;FLAGS")
  if(NOT arg_PROMISES)
    message(FATAL_ERROR "bodice: layer ${name} has no PROMISES: name the headers that users may rely on, or NOTHING.")
  endif()
  list(REMOVE_ITEM arg_PROMISES NOTHING)
  if(NOT arg_DIR)
    set(arg_DIR "${CMAKE_CURRENT_SOURCE_DIR}/${name}")
  endif()
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS "${arg_DIR}/src/*.cpp")
  if(EMSCRIPTEN)  # neither oneTBB nor spdlog is there
    list(FILTER sources EXCLUDE REGEX "/engine/src/(tbb_executor|log_sinks)[.]cpp$")
  endif()
  set(target bodice_${name})
  add_library(${target} STATIC ${sources})
  add_library(bodice::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES
    EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden
    VISIBILITY_INLINES_HIDDEN ON)
  if(NOT BODICE_INSTALL)  # compiled where something links it
    set_target_properties(${target} PROPERTIES EXCLUDE_FROM_ALL ON)
  endif()
  set(together "")
  if(arg_TOGETHER)
    set(together TOGETHER)
  endif()
  bodice_unite(${target} "${arg_DIR}/src" ${together} ${sources})
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_include_directories(${target}
    PUBLIC $<BUILD_INTERFACE:${arg_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
    PRIVATE "${arg_DIR}/src")
  set(below "")
  foreach(layer IN LISTS arg_USES)
    target_link_libraries(${target} PUBLIC bodice_${layer})
    get_property(layers GLOBAL PROPERTY BODICE_LAYER_${layer}_BELOW)
    list(APPEND below ${layers} ${layer})
  endforeach()
  list(REMOVE_DUPLICATES below)
  set(packages ${arg_PUBLIC} ${arg_PRIVATE})
  list(TRANSFORM packages REPLACE "::.*" "")  # a package's targets carry its name
  target_link_libraries(${target} PUBLIC ${arg_PUBLIC}
    PRIVATE ${arg_PRIVATE} $<BUILD_INTERFACE:${arg_HEADERS}> $<BUILD_INTERFACE:bodice_build_flags>)
  target_compile_options(${target} PRIVATE ${arg_FLAGS})
  if(name STREQUAL "geometry" OR "geometry" IN_LIST below)
    # Other flags need another precompiled header, which the first layer that has them makes.
    get_property(maker GLOBAL PROPERTY "BODICE_PRECOMPILED_WITH_${arg_FLAGS}")
    if(maker)
      bodice_precompile(${target} FROM ${maker})
    else()
      bodice_precompile(${target})
      set_property(GLOBAL PROPERTY "BODICE_PRECOMPILED_WITH_${arg_FLAGS}" ${target})
    endif()
  endif()
  set_property(GLOBAL APPEND PROPERTY BODICE_LAYERS ${name})
  set_property(GLOBAL PROPERTY BODICE_LAYER_${name}_USES ${arg_USES})
  set_property(GLOBAL PROPERTY BODICE_LAYER_${name}_BELOW ${below})
  set_property(GLOBAL PROPERTY BODICE_LAYER_${name}_PACKAGES ${packages})
  set_property(GLOBAL PROPERTY BODICE_LAYER_${name}_DIR ${arg_DIR})
  list(TRANSFORM arg_PROMISES REPLACE "(.+)" "bodice/${name}/\\1.hpp")
  set_property(GLOBAL APPEND PROPERTY BODICE_PROMISED_HEADERS ${arg_PROMISES})
endfunction()

# Sets `out` to the headers that are installed, as bodice/<layer>/<header>: the promised ones, and those that they
# include, which would otherwise be missing.
function(bodice_installed_headers out)
  get_property(open GLOBAL PROPERTY BODICE_PROMISED_HEADERS)
  set(all "")
  while(open)
    list(POP_FRONT open header)
    if(header IN_LIST all)
      continue()
    endif()
    list(APPEND all ${header})
    string(REGEX REPLACE "^bodice/([a-z_]+)/.*" "\\1" layer ${header})
    get_property(dir GLOBAL PROPERTY BODICE_LAYER_${layer}_DIR)
    file(STRINGS "${dir}/include/${header}" includes REGEX "^#include <bodice/")
    list(TRANSFORM includes REPLACE ".*<(.*)>.*" "\\1")
    list(APPEND open ${includes})
  endwhile()
  set(${out} ${all} PARENT_SCOPE)
endfunction()

# Installs the program, every layer and a package file, so that find_package(bodice COMPONENTS <layer>) gives
# bodice::<layer>. An export set a layer: one that was not requested is not there.
function(bodice_install_layers)
  include(CMakePackageConfigHelpers)
  set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/bodice")
  get_property(layers GLOBAL PROPERTY BODICE_LAYERS)
  set(bodice_layer_table "set(_bodice_layers ${layers})\n")
  foreach(layer IN LISTS layers)
    get_property(dir GLOBAL PROPERTY BODICE_LAYER_${layer}_DIR)
    install(TARGETS bodice_${layer} EXPORT bodice-${layer} ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT dev)
    install(EXPORT bodice-${layer} NAMESPACE bodice:: DESTINATION "${package_dir}" COMPONENT dev)
    get_property(below GLOBAL PROPERTY BODICE_LAYER_${layer}_BELOW)
    get_property(packages GLOBAL PROPERTY BODICE_LAYER_${layer}_PACKAGES)
    string(APPEND bodice_layer_table
           "set(_bodice_below_${layer} ${below})\nset(_bodice_packages_${layer} ${packages})\n")
  endforeach()
  get_property(c_libraries GLOBAL PROPERTY BODICE_C_LIBRARIES)
  foreach(library IN LISTS c_libraries)
    string(APPEND bodice_layer_table
           "list(APPEND _bodice_layers ${library})\nset(_bodice_below_${library})\nset(_bodice_packages_${library})\n")
  endforeach()
  bodice_installed_headers(headers)
  foreach(header IN LISTS headers)
    string(REGEX REPLACE "^bodice/([a-z_]+)/.*" "\\1" layer ${header})
    get_property(dir GLOBAL PROPERTY BODICE_LAYER_${layer}_DIR)
    cmake_path(GET header PARENT_PATH folder)
    install(FILES "${dir}/include/${header}" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/${folder}" COMPONENT dev)
  endforeach()
  if(TARGET bodice_cli)
    install(TARGETS bodice_cli RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT program)
  endif()
  configure_package_config_file("${PROJECT_SOURCE_DIR}/.cmake/bodice-config.cmake.in"
    "${PROJECT_BINARY_DIR}/bodice-config.cmake" INSTALL_DESTINATION "${package_dir}")
  write_basic_package_version_file("${PROJECT_BINARY_DIR}/bodice-config-version.cmake"
    COMPATIBILITY SameMinorVersion)
  install(FILES "${PROJECT_BINARY_DIR}/bodice-config.cmake" "${PROJECT_BINARY_DIR}/bodice-config-version.cmake"
    DESTINATION "${package_dir}" COMPONENT dev)
endfunction()
