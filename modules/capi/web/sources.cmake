# The sources of `whole` and of tryon that the WebAssembly holds. A native build reads this list, too, and stops where a
# file of it is gone, since few builds make the WebAssembly.
set(bodice_web_sources)
foreach(name IN ITEMS fit progress read_skin rig skin)  # sessions, drapes and tickets need cloth or threads
  list(APPEND bodice_web_sources "capi/src/whole/${name}.cpp")
endforeach()
# Of tryon what makes a skin and a proxy of a mesh; of io nothing, since the page reads its files itself.
foreach(name IN ITEMS load_body prepare refine_thing rigged_body scan_doubts segment_tasks stand_upright)
  list(APPEND bodice_web_sources "tryon/src/body/${name}.cpp")
endforeach()
list(TRANSFORM bodice_web_sources PREPEND "${CMAKE_CURRENT_LIST_DIR}/../../")
foreach(source IN LISTS bodice_web_sources)
  if(NOT EXISTS "${source}")
    message(FATAL_ERROR "modules/capi/web/sources.cmake names a file that is gone: ${source}")
  endif()
endforeach()
