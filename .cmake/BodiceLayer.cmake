# How bodice declares a layer, and the flags of our own build.

# Flags that let the compiler assume there is no NaN or Inf, or reorder sums,
# break the certificates of the MVEE solver and the determinism contract.
function(bodice_reject_unsafe_math_flags)
  string(TOUPPER "${CMAKE_BUILD_TYPE}" config)
  foreach(flags IN ITEMS "${CMAKE_CXX_FLAGS}" "${CMAKE_CXX_FLAGS_${config}}")
    if(flags MATCHES "-(ffast-math|Ofast|ffinite-math-only|fassociative-math|funsafe-math-optimizations)")
      message(FATAL_ERROR "bodice: ${CMAKE_MATCH_0} is forbidden: remove it from CMAKE_CXX_FLAGS. "
                          "Certificates and determinism need IEEE arithmetic.")
    endif()
  endforeach()
endfunction()

# Warnings and sanitizers live on a target that is linked PRIVATE and never
# exported, so that none of them reaches a project that embeds bodice.
function(bodice_define_build_flags)
  add_library(bodice_build_flags INTERFACE)
  if(PROJECT_IS_TOP_LEVEL)
    target_compile_options(bodice_build_flags INTERFACE
      -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Wdouble-promotion
      -Wno-missing-field-initializers  # designated initialisers leave the rest at their defaults on purpose
      -Werror)
    # g++ 12 sees overlapping copies in `"text" + std::string` that are not there (GCC bug 105651).
    target_compile_options(bodice_build_flags INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
    # clang takes `double{f}` for a promotion that nobody asked for.
    target_compile_options(bodice_build_flags INTERFACE $<$<CXX_COMPILER_ID:Clang>:-Wno-double-promotion>)
    if(BODICE_SANITIZE)
      target_compile_options(bodice_build_flags INTERFACE
        -fsanitize=${BODICE_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
      target_link_options(bodice_build_flags INTERFACE -fsanitize=${BODICE_SANITIZE})
    endif()
  endif()
endfunction()

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
