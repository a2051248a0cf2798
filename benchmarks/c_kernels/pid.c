/* A PID controller with limits and a ramp, on variables in memory. */

typedef struct {
	double setpoint, actual, kp, ki, kd, integral, last, out, low, high, ramp, target;
} pid;

pid loop = {0, 20, 1.2, 0.02, 0.4, 0, 0, 0, -100, 100, 0.5, 80};

static void step(pid *p)
{
	double error, out;
	if (p->setpoint < p->target - p->ramp)
		p->setpoint += p->ramp;
	else if (p->setpoint > p->target + p->ramp)
		p->setpoint -= p->ramp;
	else
		p->setpoint = p->target;
	error = p->setpoint - p->actual;
	p->integral += error * p->ki;
	if (p->integral > p->high)
		p->integral = p->high;
	if (p->integral < p->low)
		p->integral = p->low;
	out = error * p->kp + p->integral + (error - p->last) * p->kd;
	p->last = error;
	p->out = out > p->high ? p->high : out < p->low ? p->low : out;
	p->actual += (p->out - p->actual) * 0.01;
}

int run(int count)
{
	for (int i = 0; i < count; i++) {
		step(&loop);
		if (i % 1000 == 0)
			loop.target = -loop.target;
	}
	return (int)(loop.actual * 1e6);
}
