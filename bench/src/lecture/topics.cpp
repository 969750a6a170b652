#include "topics.h"

namespace koksma::lecture {

std::span<const Topic> topics() noexcept {
    static constexpr Topic kTopics[]{
        {"bounces", "One more bounce",
         "Light at a point is what shines there and what is scattered there of the light that arrives: with every recursion the picture "
         "gains the light that was scattered once more.",
         bounces},
        {"parts", "Le, Ldirect, Lindirect",
         "The picture is the sum of three: light that shines into the camera, light that was scattered once, and all other. Each has its "
         "own error.",
         parts},
        {"direct-light", "With and without direct light sampling",
         "A path that waits until it meets a lamp mostly waits in vain. Asking a point of the lamp at every vertex finds the same light; "
         "weights make one estimate of both.",
         direct_light},
        {"directions", "Directions from the BSDF, or uniform ones",
         "Directions drawn in proportion to the BSDF times the cosine have less variance than those drawn uniformly on the hemisphere.",
         directions},
        {"truncation", "Truncation by depth and by radiance",
         "A path must end. Cutting it at a depth, or where it carries little, leaves light out: the bias is the rest of the series.",
         truncation},
        {"roulette", "Russian roulette, and I_roulette",
         "Ending a path by chance and dividing by the chance to go on leaves nothing out, and costs variance. I_roulette = f(x / P) / P if "
         "x < P, else 0: one number decides, and what is left of it is used again.",
         roulette},
        {"absorption", "Absorption by the surface, or by what the path carries",
         "Absorption = 1 - reflectance ends paths as light itself does. A path that carries much should go on all the same: survival by "
         "throughput looks at the whole path.",
         absorption},
        {"branching", "Path tracing against stochastic ray tracing",
         "A tree of rays spends most of its rays where they count least. At equally many rays, are many thin paths or few bushy trees "
         "better?",
         branching},
        {"rays", "1, 4, 16, 256 rays a pixel", "Four times the rays, half the error.", rays},
        {"antialiasing", "Rays through the centre of a pixel, or all over it",
         "A pixel is the mean over its area. Rays through its centre are samples of a finer picture than the film can hold: aliasing, "
         "which more rays do not cure.",
         antialiasing},
        {"adaptive", "Uniform against adaptive sampling at an average of 64 samples",
         "Rays should go where the noise is. Whoever lets the samples themselves decide how many follow must throw the first ones away, or "
         "the picture is too dark.",
         adaptive},
        {"sequences", "Random numbers against sequences",
         "A sequence fills the space of paths more evenly than chance does: the error falls faster where the integrand lets it.",
         sequences},
    };
    return kTopics;
}

}  // namespace koksma::lecture
