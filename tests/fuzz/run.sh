#!/bin/sh
# Fuzzes the loaders: tests/fuzz/run.sh [seconds for each of three] [inputs at most]. Seeds: the scenes and meshes of this repository.
# What it finds lies in build/fuzz/found. Needs Clang with libFuzzer (CXX=clang++-16 by default; on Debian also libclang-rt-16-dev).
set -e
cd "$(dirname "$0")/../.."
seconds=${1:-600} runs=${2:--1}
cmake -S . -B build/fuzz -G Ninja -DKOKSMA_FUZZERS=ON -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_CXX_COMPILER="${CXX:-clang++-16}" > /dev/null
ninja -C build/fuzz fuzz_scene fuzz_mesh fuzz_image
seeds=build/fuzz/seeds
mkdir -p $seeds/scene $seeds/mesh $seeds/image build/fuzz/found build/fuzz/files
cp scenes/*.xml $seeds/scene/
for f in $(find scenes -name '*.obj' -o -name '*.ply' -o -name '*.serialized' -o -name '*.vol'); do [ "$(wc -c < "$f")" -lt 65536 ] && cp "$f" $seeds/mesh/; done
python3 tests/fuzz/seeds.py $seeds
for d in scenes/*/; do cp -r "$d" build/fuzz/files/; done
for what in scene mesh image; do
  mkdir -p build/fuzz/corpus-$what
  echo "== $what"
  KOKSMA_FUZZ_FILES=build/fuzz/files build/fuzz/bin/fuzz_$what -max_total_time="$seconds" -runs="$runs" -timeout=10 -rss_limit_mb=2048 -max_len=4096 \
    -artifact_prefix=build/fuzz/found/$what- -print_final_stats=1 build/fuzz/corpus-$what $seeds/$what < /dev/null 2>&1 | tail -n 25
done
