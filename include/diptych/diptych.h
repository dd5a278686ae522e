// Diptych, a renderer with two panels. All of the library.
#pragma once

#include "diptych/bench.h"
#include "diptych/converge.h"
#include "diptych/error.h"
#include "diptych/film.h"
#include "diptych/measure.h"
#include "diptych/scene.h"
#include "diptych/session.h"
#include "diptych/settings.h"
#include "diptych/version.h"
