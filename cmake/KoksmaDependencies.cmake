# Where the dependencies come from, and every difference between their versions that CMake can see.
# (Differences that C++ sees: lib/src/scene/embree.h for Embree 3 and 4, tests/koksma_catch.h for Catch2 2 and 3.)

find_package(embree 4 QUIET CONFIG)
if(NOT embree_FOUND)
  find_package(embree 3.13 REQUIRED CONFIG)
endif()

# Imath's configuration file of Debian 12 prints nine alarming lines about Python; they mean nothing here.
set(koksma_log_level ${CMAKE_MESSAGE_LOG_LEVEL})
set(CMAKE_MESSAGE_LOG_LEVEL NOTICE)
find_package(OpenEXR 3 REQUIRED CONFIG)
set(CMAKE_MESSAGE_LOG_LEVEL ${koksma_log_level})

find_package(glm REQUIRED)
find_package(TBB REQUIRED CONFIG)
find_package(pugixml REQUIRED CONFIG)
find_package(tinyobjloader REQUIRED CONFIG)
find_package(fmt REQUIRED CONFIG)
find_package(nlohmann_json 3 REQUIRED CONFIG)
find_package(CLI11 REQUIRED CONFIG)
find_package(Threads REQUIRED)
find_package(ZLIB REQUIRED)
find_package(hwy REQUIRED CONFIG)

# stb has no CMake package.
find_path(KOKSMA_STB_INCLUDE_DIR stb_image.h PATH_SUFFIXES stb REQUIRED)
mark_as_advanced(KOKSMA_STB_INCLUDE_DIR)
add_library(koksma_stb INTERFACE)
target_include_directories(koksma_stb SYSTEM INTERFACE $<BUILD_INTERFACE:${KOKSMA_STB_INCLUDE_DIR}>)

if(KOKSMA_MICRO_BENCHMARKS)
  find_package(benchmark REQUIRED CONFIG)
endif()
