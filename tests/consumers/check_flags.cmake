# A program that was compiled otherwise than bodice stops with a sentence or does not link: it would read garbage.
file(MAKE_DIRECTORY "${SCRATCH}")
file(WRITE "${SCRATCH}/main.cpp" "#include <bodice/engine/version.hpp>\nint main() {}\n")
file(GLOB_RECURSE engine "${PREFIX}/libbodice_engine.a")
function(compile result)
  execute_process(COMMAND "${COMPILER}" -O0 "-I${PREFIX}/include" ${ARGN} "${SCRATCH}/main.cpp" "${engine}"
                    -o "${SCRATCH}/main"
                  RESULT_VARIABLE failed OUTPUT_VARIABLE out ERROR_VARIABLE why)
  set(${result} "${out}${why}" PARENT_SCOPE)
endfunction()
function(must_report sentence)
  compile(why ${ARGN})
  if(NOT why MATCHES "${sentence}")
    message(SEND_ERROR "${ARGN}: expected '${sentence}' in:\n${why}")
  endif()
endfunction()

must_report("need C\\+\\+20" -std=c++17)
must_report("undefined.*built_with_GLIBCXX_DEBUG" -std=c++20 -D_GLIBCXX_DEBUG)
must_report("undefined.*built_with_EIGEN_DEFAULT_TO_ROW_MAJOR" -std=c++20 -DEIGEN_DEFAULT_TO_ROW_MAJOR)
compile(why -std=c++20)
if(why MATCHES "undefined.*built_with")
  message(SEND_ERROR "A program with the same flags does not link:\n${why}")
endif()
