#pragma once
// What the batch kernel's sources see before they are compiled for each instruction set.

#include <koksma/integrators/path.h>
#include <koksma/integrators/thread_clock.h>
#include <koksma/scene/light_choice.h>
#include <koksma/scene/light_sampling.h>

#include "batch/batch_state.h"
#include "flatten.h"
#include "kernel_sets.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#define KOKSMA_SHARED_MATHS <koksma/scene/all_maths.h>
