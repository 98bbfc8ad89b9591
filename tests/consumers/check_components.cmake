# What find_package must refuse, and by which message: a layer without its package, requested by name or with
# all the others, and a layer that there is not.
function(must_be_refused name components why)
  file(WRITE "${SCRATCH}/${name}/CMakeLists.txt"
       "cmake_minimum_required(VERSION 3.25)\nproject(user LANGUAGES CXX)\n"
       "find_package(bodice REQUIRED CONFIG ${components})\n")
  execute_process(COMMAND ${CMAKE_COMMAND} -S "${SCRATCH}/${name}" -B "${SCRATCH}/${name}/build" -G "${GENERATOR}"
                  ${SETTINGS} "-DCMAKE_PREFIX_PATH=${PREFIX}" -DCMAKE_DISABLE_FIND_PACKAGE_assimp=ON
                  RESULT_VARIABLE failed OUTPUT_QUIET ERROR_VARIABLE message)
  string(REGEX REPLACE "[ \n]+" " " message "${message}")
  if(NOT failed)
    message(SEND_ERROR "find_package(bodice ${components}) without assimp was let through")
  elseif(NOT message MATCHES "${why}")
    message(SEND_ERROR "find_package(bodice ${components}) without assimp does not report `${why}`:\n${message}")
  endif()
endfunction()

must_be_refused(by_name "COMPONENTS tryon" "bodice::io needs assimp, which is not found: install it")
must_be_refused(with_all "" "bodice::io needs assimp, which is not found: install it")
must_be_refused(unknown "COMPONENTS colision" "has no layer colision: it was built with engine")
