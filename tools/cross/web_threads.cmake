# The same with threads, for pages that browsers isolate from others (headers COOP and COEP).
include(${CMAKE_CURRENT_LIST_DIR}/web.cmake)
add_compile_options(-pthread)
add_link_options(-pthread)
