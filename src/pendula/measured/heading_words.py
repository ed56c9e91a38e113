"""Words that headers of recordings are made of, without accents, in the languages of their writers.

English, Spanish, German, French, Italian, Portuguese; symbols and what programs write.
"""

from __future__ import annotations

TIME = {
    *("t", "time", "times", "tiempo", "tiempos", "zeit", "temps", "tempo", "instant", "instante"),
    *("timestamp", "timestamps", "elapsed", "seconds", "segundos", "sekunden", "secondes", "sec"),
    *("clock", "reloj", "zeitpunkt", "secondi", "millis", "ms", "s", "seg"),
}
NOT_TIME = {"shift", "system", "lag", "delay", "text", "absolute", "event", "unix", "epoch"}
FRAME = {
    *("frame", "frames", "fotograma", "fotogramas", "cuadro", "cuadros", "bild", "bilder", "index"),
    *("indice", "step", "sample", "samples", "muestra", "muestras", "n", "no", "nr", "image"),
    *("framenumber", "frameno", "imagen", "quadro", "fotogramma", "trama", "i", "idx"),
}
ANGLE = {
    *("theta", "teta", "thetas", "angle", "angles", "angulo", "angulos", "angolo", "winkel", "ang"),
    *("phi", "varphi", "vartheta", "fi", "auslenkwinkel", "auslenkung", "inclinacion", "th"),
    *("inclination", "neigung", "tilt", "inclinaison", "inclinometro", "deflection", "ausschlag"),
    *("drehwinkel", "angleposition", "desviacion", "angulaire", "angular", "angulare", "angolare"),
}
WEAK_ANGLE = {"alpha", "alfa", "beta", "psi", "gamma", "pitch", "roll", "yaw"}
ANGULAR = {"angular", "angulaire", "angolare", "angulare", "ang", "rotational", "rotacional"}
RATE = {
    *("omega", "w", "om", "gyro", "gyroscope", "gyroskop", "giroscopio", "gyr", "gyrometer"),
    *("winkelgeschwindigkeit", "drehrate", "thetadot", "dthetadt", "dtheta", "thetap", "phidot"),
    *("angularvelocity", "gyrodata", "rotationrate", "giroscopo", "girometro", "gyrometre"),
}
VELOCITY = {
    *("velocity", "velocidad", "vitesse", "velocita", "velocidade", "geschwindigkeit", "speed"),
    *("rapidez", "vel", "rate", "dot", "dt", "rapidite", "tasa"),
}
ACCELERATION = {
    *("acceleration", "aceleracion", "beschleunigung", "accelerazione", "aceleracao", "accel"),
    *("acc", "acelerometro", "accelerometer", "accelerometre", "accelerometro", "gforce"),
    *("accelero", "beschleunigungssensor", "acel", "gfx"),
}
LINEAR = {"linear", "lineal", "lineare", "lineaire", "linearacceleration", "without", "ohne", "sin"}
LINEAR |= {"user", "useracceleration", "senza", "sem", "lin"}
ABSOLUTE = {"absolute", "absoluta", "absolut", "abs", "absolue", "total", "magnitude", "modulo"}
ABSOLUTE |= {"betrag", "norm", "norme", "magnitud", "resultant", "resultante", "assoluta", "mod"}
GATE = {"gatestate", "gate", "photogate", "fotopuerta", "lichtschranke", "state", "estado"}
FORCE = {"force", "fuerza", "kraft", "forza", "forca", "tension", "load", "zugkraft", "carga"}
FORCE |= {"tensione", "tensao"}
PERIOD = {
    *("period", "periods", "periodo", "periodos", "periode", "periodes", "periodendauer"),
    *("schwingungsdauer", "perioden", "periodi"),
}
LENGTH = {
    *("length", "lengths", "longitud", "longitudes", "largo", "lange", "laenge", "longueur"),
    *("lunghezza", "comprimento", "l", "pendellange", "fadenlange", "longueurs", "len"),
    *("seillange", "cuerda", "string"),
}
AMPLITUDE = {
    *("amplitude", "amplitud", "amplitudes", "amplitudine", "anfangswinkel", "startwinkel"),
    *("theta0", "amp", "maximalwinkel"),
}
START = {"initial", "inicial", "start", "release", "iniziale", "initiale", "anfang", "maximum"}
START |= {"maximo", "max", "maxima", "inicio", "starting"}
SIMULATED = (
    *("sim", "mode", "fit", "ajust", "theor", "teor", "exact", "predi", "numeri", "analyt"),
    *("analit", "interpol", "smooth", "suaviz", "thao", "regres", "rk4", "euler", "esperad"),
)
NOT_SIMULATED = {"exactitud", "exactitude"}
ERROR = {
    *("err", "error", "erreur", "errore", "erro", "fehler", "sigma", "std", "stdev", "sd", "se"),
    *("uncertainty", "incertidumbre", "incertitude", "unsicherheit", "residual", "residuo"),
    *("residuals", "residuos", "diff", "difference", "diferencia", "incertezza", "desv", "errors"),
    *("variance", "likelihood", "confidence", "errores", "u", "delta"),
}
OTHER = {  # known, and nothing that is asked for here
    *("r", "radius", "radio", "rayon", "k", "energy", "energia", "energie", "ke", "pe", "mass"),
    *("vx", "vy", "vz", "temperature", "temperatura", "pressure", "frequency", "frecuencia"),
    *("frequenz", "frequence", "autocorrelation", "height", "altura", "hohe", "momentum"),
    *("latitude", "longitude", "lux", "magnetic", "proximity", "value", "potential", "kinetic"),
    *("potencial", "cinetica", "masa", "masse", "massa", "g", "gravity", "gravedad", "area"),
    *("damping", "amortiguamiento", "width", "frequenza", "resonance", "rel"),
}
RUN = {
    *("run", "runs", "serie", "series", "reihe", "trial", "trials", "lauf", "corrida", "ensayo"),
    *("intento", "messung", "medida", "medicion", "prise", "essai", "prova", "toma", "versuch"),
    *("corsa", "course", "repeticion", "tirada", "mesure", "misura", "experimento", "messreihe"),
    *("datensatz", "dataset", "set", "intentos", "test", "try", "attempt", "ensaio", "daten"),
    *("experiment", "video", "jeu", "measurement", "ejecucion", "tentativa", "rep"),
}
POSITION = {
    *("position", "posicion", "pos", "posizione", "posicao", "coordinate", "coordenada", "centro"),
    *("center", "centre", "centroid", "cm", "mass", "masa", "masse", "massa", "bob", "ball", "m"),
    *("displacement", "desplazamiento", "punto", "point", "punkt", "tip", "marker", "marcador"),
    *("pendulum", "pendulo", "pendel", "pendule", "pendolo", "ort", "spostamento", "koordinate"),
    *("body", "cuerpo", "corpo", "korper", "kugel", "bola", "coord", "location", "p", "c"),
}
UPRIGHT = {"upright", "top", "inverted", "arriba", "vertical_up", "up", "haut", "oben", "invertido"}
UPRIGHT |= {"invertida", "alto"}
NUMBERS = {
    **{"five": 5, "cinco": 5, "funf": 5, "cinq": 5, "cinque": 5},
    **{"ten": 10, "diez": 10, "zehn": 10, "dix": 10, "dieci": 10, "dez": 10},
    **{"twenty": 20, "veinte": 20, "zwanzig": 20, "vingt": 20, "venti": 20, "vinte": 20},
    **{"fifty": 50, "cincuenta": 50, "funfzig": 50, "hundred": 100, "cien": 100},
    **{"three": 3, "tres": 3, "drei": 3, "trois": 3, "tre": 3},
}
SWINGS = (
    r"(?:swings?|oscil\w*|oszil\w*|schwing\w*|periods?|periodos?|perioden?|periodes?|periodi|"
    r"cycles?|ciclos?|cicli|balanc\w*|vaiven\w*|idas?|vueltas?|t)"
)
