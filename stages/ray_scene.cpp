// SPDX-License-Identifier: Apache-2.0
#include "stages/ray_scene.h"
